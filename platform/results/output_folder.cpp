// SPDX-License-Identifier: Apache-2.0
#include "platform/results/output_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>

#include "tlm/error.hpp"

namespace parallax {

namespace fs = std::filesystem;

OutputFolder::OutputFolder(fs::path path) : path_(std::move(path)) {
  if (path_.empty()) throw UserError("the name of the output folder is empty");
  make(path_);
  if (::faccessat(AT_FDCWD, path_.c_str(), W_OK | X_OK, AT_EACCESS) != 0) {
    throw UserError(
        fmt::format("cannot write to the output folder {}: {}", path_.string(), std::strerror(errno)));
  }
}

OutputFolder::~OutputFolder() {
  opened_.clear();
  written_.clear();
  remove_made();
}

void OutputFolder::remove_old() {
  if (!is_old_) return;
  std::vector<fs::path> files, folders;
  std::error_code ignored;
  for (fs::recursive_directory_iterator entry(path_, ignored), end; entry != end; entry.increment(ignored)) {
    if (entry->is_directory(ignored)) {
      if (entry.depth() > 0) entry.disable_recursion_pending();
      folders.push_back(entry->path());
    } else if (is_old_(entry->path().lexically_relative(path_).string())) {
      files.push_back(entry->path());
    }
  }
  is_old_ = nullptr;
  for (const fs::path& file : files) fs::remove(file, ignored);
  for (const fs::path& folder : folders) {
    const bool ours = std::any_of(files.begin(), files.end(),
                                  [&](const fs::path& file) { return file.parent_path() == folder; });
    if (ours) fs::remove(folder, ignored);  // if it is empty
  }
}

void OutputFolder::remove_made() {
  std::error_code not_empty;
  for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder) fs::remove(*folder, not_empty);
}

void OutputFolder::make(const fs::path& folder) {
  fs::path part;
  for (const fs::path& name : folder) {
    part /= name;
    std::error_code failed;
    if (fs::is_directory(part, failed)) continue;
    if (fs::exists(fs::symlink_status(part, failed))) {
      throw UserError(
          fmt::format("cannot make the output folder {}: {} is a file", folder.string(), part.string()));
    }
    fs::create_directory(part, failed);
    if (failed) {
      remove_made();
      throw UserError(fmt::format("cannot make the output folder {}: {}", folder.string(), failed.message()));
    }
    made_.push_back(part);
  }
}

std::unique_ptr<OutputFile> OutputFolder::create(const std::string& name) {
  const fs::path target = path_ / name;
  if (target.parent_path() != path_) make(target.parent_path());
  return std::make_unique<OutputFile>(target);
}

OutputFile& OutputFolder::open(const std::string& name) {
  opened_.push_back(create(name));
  return *opened_.back();
}

void OutputFolder::write(const std::string& name, std::string_view content) {
  written_.push_back(create(name));
  written_.back()->write(content);
  written_.back()->close();  // a run over many files must not hold them all open
}

void OutputFolder::write(const std::string& name, const std::vector<unsigned char>& content) {
  write(name, std::string_view(reinterpret_cast<const char*>(content.data()), content.size()));
}

void OutputFolder::publish() {
  std::vector<std::unique_ptr<OutputFile>> files = std::exchange(opened_, {});
  std::move(written_.begin(), written_.end(), std::back_inserter(files));
  written_.clear();
  publish(files);
}

void OutputFolder::publish_written() { publish(std::exchange(written_, {})); }

void OutputFolder::publish(const std::vector<std::unique_ptr<OutputFile>>& files) {
  for (const auto& file : files) file->close();
  remove_old();
  for (const auto& file : files) file->publish();
}

}  // namespace parallax
