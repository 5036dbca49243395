// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "platform/input/calibration_request.hpp"

namespace parallax {

/// A map of a YAML file. Every failure is a UserError naming file and entry, and for what is no YAML the
/// line.
class YamlEntries {
 public:
  using Names = std::vector<std::string>;

  /// The top level of a file's first document. A line %YAML:1.0 at its beginning, which is OpenCV's and no
  /// YAML, does not count.
  explicit YamlEntries(const CalibrationRequest::File& file);

  bool has(const std::string& name) const;
  /// The first of the names that it has, else the first.
  std::string present(const Names& names) const;
  /// "file: entry", for messages.
  std::string where(const std::string& name) const { return where_ + name; }

  YamlEntries map(const std::string& name) const;
  /// A word or sentence; throws when there is none.
  std::string text(const std::string& name) const;
  double number(const std::string& name) const;
  /// All finite. A list, a list of rows, or a map with rows, cols and data.
  std::vector<double> numbers(const std::string& name) const;
  /// The same, of rows * columns numbers, row by row; of rows, each has `columns`.
  std::vector<double> matrix(const std::string& name, int rows, int columns) const;

 private:
  YamlEntries(const YAML::Node& node, std::string where);
  YAML::Node find(const std::string& name) const;

  YAML::Node node_;
  std::string where_;
};

}  // namespace parallax
