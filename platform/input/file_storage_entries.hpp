// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace cv {
class FileNode;
class FileStorage;
}  // namespace cv

namespace parallax {

/// Entries of one or more OpenCV FileStorage files, looked up under any of several names. Every failure is a
/// UserError naming file and entry.
class CalibrationFile {
 public:
  using Names = std::vector<std::string>;
  using Shape = std::pair<int, int>;  ///< rows, columns

  explicit CalibrationFile(const std::vector<std::string>& paths);

  /// All paths, for messages.
  const std::string& name() const { return name_; }
  bool has(const Names& names) const;
  /// Row-major, all finite. With `shapes` given, the entry must have one of them; a plain list counts as a
  /// column.
  std::vector<double> numbers(const Names& names, const std::vector<Shape>& shapes) const;
  std::string text(const Names& names, const std::string& otherwise) const;

 private:
  cv::FileNode find(const Names& names) const;

  std::vector<cv::FileStorage> files_;
  std::string name_;
};

}  // namespace parallax
