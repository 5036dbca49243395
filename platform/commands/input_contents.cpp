// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/input_contents.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "platform/results/file_content.hpp"

namespace parallax {
namespace {

// What a file holds; of a folder, what is in it and when it was written.
std::string content_text(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    std::vector<std::string> entries;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path, ignored)) {
      if (!entry.is_regular_file(ignored)) continue;
      entries.push_back(fmt::format("{} {} {}", entry.path().string(), entry.file_size(ignored),
                                    entry.last_write_time(ignored).time_since_epoch().count()));
    }
    std::sort(entries.begin(), entries.end());
    FileContent names;
    for (const std::string& entry : entries) names.add(entry.data(), entry.size());
    return fmt::format("{:08x}", names.crc);
  }
  // A pipe would be read empty here.
  return std::filesystem::is_regular_file(path, ignored) ? fmt::format("{:08x}", content_of(path).crc) : "-";
}

}  // namespace

std::string input_contents(const RunOptions& options) {
  std::vector<std::string> files{options.left, options.right, options.input, options.map};
  files.insert(files.end(), options.calibration.begin(), options.calibration.end());
  std::string text;
  for (const std::string& file : files) {
    if (!file.empty()) text += " " + content_text(file);
  }
  return text;
}

}  // namespace parallax
