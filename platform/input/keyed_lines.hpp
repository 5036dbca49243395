// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "platform/input/calibration_request.hpp"

namespace parallax {

/// Lines of a name, a separator and numbers between blanks; brackets, commas and semicolons count as blanks.
/// Lines without a separator do not count. Line ends may be those of Windows. Every failure is a UserError
/// naming file and entry.
class KeyedLines {
 public:
  KeyedLines(const CalibrationRequest::File& file, char separator);

  bool has(const std::string& name) const { return values_.count(name) != 0; }
  /// "file: entry", for messages.
  std::string where(const std::string& name) const { return where_ + name; }
  /// So many, all finite. Two lines of the same name must be the same.
  std::vector<double> numbers(const std::string& name, std::size_t count) const;
  double number(const std::string& name) const { return numbers(name, 1)[0]; }

 private:
  std::string where_;
  std::map<std::string, std::vector<std::string>> values_;
};

}  // namespace parallax
