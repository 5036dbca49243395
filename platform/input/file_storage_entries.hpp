// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "platform/input/calibration_request.hpp"

namespace cv {
class FileNode;
class FileStorage;
}  // namespace cv

namespace parallax {

/// Entries of one or more OpenCV FileStorage files, looked up under any of several names. An entry that
/// stands in several places must be the same in all. Every failure is a UserError naming file and entry.
class FileStorageEntries {
 public:
  using Names = std::vector<std::string>;
  using Shape = std::pair<int, int>;  ///< rows, columns

  explicit FileStorageEntries(const std::vector<CalibrationRequest::File>& files);
  ~FileStorageEntries();

  bool has(const Names& names) const;
  /// Row-major, all finite. With `shapes` given, the entry must have one of them; a plain list counts as a
  /// column.
  std::vector<double> numbers(const Names& names, const std::vector<Shape>& shapes) const;
  std::string text(const Names& names, const std::string& otherwise) const;
  /// "file: entry" as it stands there, for messages; with all files when it is missing.
  std::string where(const Names& names) const;

 private:
  struct File;
  struct Place;

  std::vector<Place> places(const Names& names) const;
  [[noreturn]] void missing(const Names& names) const;

  std::vector<File> files_;
};

}  // namespace parallax
