// SPDX-License-Identifier: Apache-2.0
#include "platform/results/file_index.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>

#include "platform/results/output_file.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

namespace fs = std::filesystem;

constexpr const char* kIndexHead =
    "# What parallax wrote into this folder: bytes, CRC-32, name. A file that is not named here, or that has "
    "changed since, "
    "is left alone.\n";

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

std::string line_of(const std::string& name, const FileContent& content) {
  return fmt::format("{} {:08x} {}\n", content.bytes, content.crc, name);
}

}  // namespace

FileIndex::FileIndex(fs::path folder, const std::set<std::string>& names) : folder_(std::move(folder)) {
  std::error_code ignored;
  const fs::file_status status = fs::symlink_status(folder_ / kName, ignored);
  if (!fs::exists(status)) return;
  if (!fs::is_regular_file(status)) {
    throw UserError(fmt::format("{} is not a file, but results are listed there; choose another folder",
                                (folder_ / kName).string()));
  }
  constexpr std::uintmax_t kLargestIndex = std::uintmax_t{1} << 28;
  if (const std::uintmax_t bytes = fs::file_size(folder_ / kName, ignored); bytes > kLargestIndex) {
    throw UserError(fmt::format("{} has {} bytes, which no list of results has; choose another folder",
                                (folder_ / kName).string(), bytes));
  }
  std::ifstream file(folder_ / kName);
  for (std::string line; std::getline(file, line);) {
    unsigned long long bytes = 0;
    unsigned crc = 0;
    int used = 0;
    if (std::sscanf(line.c_str(), "%19llu %8x %n", &bytes, &crc, &used) != 2 || used == 0) continue;
    const std::string name = line.substr(static_cast<std::size_t>(used));
    if (names.count(name) > 0) known_[name].insert({bytes, crc});
  }
}

bool FileIndex::wrote(const std::string& name) const {
  const auto found = known_.find(name);
  std::error_code ignored;
  if (found == known_.end() || !fs::is_regular_file(fs::symlink_status(folder_ / name, ignored)))
    return false;
  const std::uint64_t longest = found->second.rbegin()->bytes;
  return found->second.count(content_of(folder_ / name, longest)) > 0;
}

void FileIndex::add(const std::vector<std::pair<std::string, FileContent>>& files) {
  std::string lines;
  for (const auto& [name, content] : files) lines += line_of(name, content);
  if (std::exchange(begun_, true)) {
    const File file(std::fopen((folder_ / kName).c_str(), "ab"));
    if (!file || std::fwrite(lines.data(), 1, lines.size(), file.get()) != lines.size() ||
        std::fflush(file.get()) != 0) {
      throw UserError(fmt::format("cannot write {}: {}", (folder_ / kName).string(), std::strerror(errno)));
    }
  } else {
    std::string before = kIndexHead;
    for (const auto& [name, contents] : known_) {
      for (const FileContent& content : contents) before += line_of(name, content);
    }
    write_file(folder_ / kName, before + lines);
  }
  for (const auto& [name, content] : files) known_[name].insert(content);
}

}  // namespace parallax
