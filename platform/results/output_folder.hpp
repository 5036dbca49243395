// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "platform/results/output_file.hpp"

namespace parallax {

/// The folder of a run's results. Files are opened or written in any order and appear together at publish():
/// a reader sees the whole set of a frame or none of it. What was not published when the folder is destroyed
/// is removed, and so is a folder that this object made and that stayed empty.
class OutputFolder {
 public:
  /// Makes the folder if need be. Throws UserError when that fails, when a file has that name, or when the
  /// folder cannot be written to: before any work is done, not after.
  explicit OutputFolder(std::filesystem::path path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Files that were there before and for whose path `is_old` says yes are removed at the first publish():
  /// what a reader finds then is of one run.
  void replace(std::function<bool(const std::string& path)> is_old) { is_old_ = std::move(is_old); }

  /// A file of the next publish(); `name` may lie in a subfolder, which is made. The reference is good until
  /// then.
  OutputFile& open(const std::string& name);

  /// A whole file of the next publish().
  void write(const std::string& name, std::string_view content);
  void write(const std::string& name, const std::vector<unsigned char>& content);

  /// Completes all files, then gives each its name. Throws UserError when the disk is full; then none
  /// appears.
  void publish();
  /// The same for the files that are written as a whole: those that were opened go on.
  void publish_written();

 private:
  std::unique_ptr<OutputFile> create(const std::string& name);
  void publish(const std::vector<std::unique_ptr<OutputFile>>& files);
  void make(const std::filesystem::path& folder);
  void remove_old();
  void remove_made();  ///< those that are empty

  std::filesystem::path path_;
  std::function<bool(const std::string&)> is_old_;  ///< until the first publish()
  std::vector<std::filesystem::path> made_;         ///< folders that did not exist before, outermost first
  std::vector<std::unique_ptr<OutputFile>> opened_, written_;  ///< of the next publish()
};

}  // namespace parallax
