// SPDX-License-Identifier: Apache-2.0
#include "platform/results/output_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <set>

#include "tlm/error.hpp"

namespace parallax {

namespace fs = std::filesystem;

namespace {

// Files one folder deep, as paths in the folder; links are not followed.
std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (fs::recursive_directory_iterator entry(folder, ignored), end; entry != end; entry.increment(ignored)) {
    if (fs::is_directory(entry->symlink_status(ignored))) {
      if (entry.depth() > 0) entry.disable_recursion_pending();
    } else {
      names.push_back(entry->path().lexically_relative(folder).string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

OutputFolder::OutputFolder(fs::path path, FolderPlan plan) : path_(std::move(path)), plan_(std::move(plan)) {
  if (path_.empty()) throw UserError("the name of the output folder is empty");
  make(path_);
  for (lock_.emplace(path_); !lock_->is_at(path_); lock_.emplace(path_)) make(path_);
  if (::faccessat(AT_FDCWD, path_.c_str(), W_OK | X_OK, AT_EACCESS) != 0) {
    throw UserError(
        fmt::format("cannot write to the output folder {}: {}", path_.string(), std::strerror(errno)));
  }
  prepare();
}

OutputFolder::~OutputFolder() {
  opened_.clear();
  written_.clear();
  remove_made();
}

void OutputFolder::prepare() {
  remove_abandoned();
  const std::vector<std::string> names = names_in(path_);
  index_.emplace(path_, std::set<std::string>(names.begin(), names.end()));
  for (const std::string& name : names) {
    if (plan_.replaces(name) && index_->wrote(name)) old_.push_back(name);
  }
  check_inputs(names);
  for (const std::string& name : names) {
    if (plan_.writes(name)) check_writable(name);
  }
}

void OutputFolder::remove_abandoned() {
  for (const std::string& name : names_in(path_)) {
    const fs::path file(name);
    const std::string target = target_of_temporary(file.filename().string());
    if (target.empty()) continue;
    const std::string result = (file.parent_path() / target).string();
    const bool ours = plan_.writes(result) || plan_.replaces(result) || target == FileIndex::kName;
    std::error_code not_empty;
    if (ours && remove_if_abandoned(path_ / file) && file.has_parent_path())
      fs::remove(path_ / file.parent_path(), not_empty);
  }
}

void OutputFolder::check_inputs(const std::vector<std::string>& names) const {
  const InputFiles inputs(plan_.inputs);
  for (const std::string& name : names) {
    if (!plan_.writes(name) && !std::binary_search(old_.begin(), old_.end(), name)) continue;
    if (const auto input = inputs.name_of(path_ / name)) {
      throw UserError(
          fmt::format("--out {} would replace or remove {}, which is read: {} is the name of a result; "
                      "choose another folder",
                      path_.string(), *input, (path_ / name).string()));
    }
  }
}

void OutputFolder::check_writable(const std::string& name) const {
  std::error_code ignored;
  const fs::path target = path_ / name;
  const fs::file_status status = fs::symlink_status(target, ignored);
  if (!fs::exists(status) || index_->wrote(name)) return;
  const fs::file_status behind = fs::status(target, ignored);
  if (fs::exists(behind) && !fs::is_regular_file(behind))
    return;  // a pipe, say: it is written to, not replaced
  throw UserError(
      fmt::format("{} would be replaced, but is no result as parallax wrote it there ({}); move it away, or "
                  "choose another folder",
                  target.string(), FileIndex::kName));
}

std::string OutputFolder::name_of(const OutputFile& file) const {
  return file.target().lexically_relative(path_).string();
}

void OutputFolder::remove_old() {
  std::error_code ignored;
  for (const std::string& name : std::exchange(old_, {})) {
    if (!index_->wrote(name)) continue;  // somebody has changed it meanwhile
    fs::remove(path_ / name, ignored);
    const fs::path folder = fs::path(name).parent_path();
    if (!folder.empty()) fs::remove(path_ / folder, ignored);  // if it is empty
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
  if (files.empty()) return;
  std::vector<std::pair<std::string, FileContent>> contents;
  for (const auto& file : files) {
    file->close();
    contents.emplace_back(name_of(*file), file->content());
    check_writable(contents.back().first);
  }
  index_->add(contents);
  remove_old();
  for (const auto& file : files) file->publish();
}

}  // namespace parallax
