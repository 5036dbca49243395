// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "platform/results/file_content.hpp"

namespace parallax {

/// .parallax_files of a folder: a line for each file that this program wrote there, with its content. What it
/// does not name, or what has changed since, is somebody else's: it is neither removed nor replaced. Lines
/// are added before the files appear, so that a program that is ended in between leaves none that is unknown;
/// of two lines of a file either counts.
class FileIndex {
 public:
  static constexpr const char* kName = ".parallax_files";

  /// Reads the lines about `names`, paths within the folder. What is no line of an index counts for nothing.
  /// Throws UserError when something other than a file has its name, or one that is too large.
  FileIndex(std::filesystem::path folder, const std::set<std::string>& names);

  /// Whether the file of this name, which exists, is as this program wrote it.
  bool wrote(const std::string& name) const;

  /// Adds lines. The first time the index is written anew, without lines of files that were not asked for:
  /// they are not there any more. Throws UserError when the disk is full.
  void add(const std::vector<std::pair<std::string, FileContent>>& files);

 private:
  std::filesystem::path folder_;
  std::map<std::string, std::set<FileContent>> known_;
  bool begun_ = false;
};

}  // namespace parallax
