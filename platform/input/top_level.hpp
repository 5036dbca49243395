// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

namespace parallax {

/// What a text file has at the beginning of its lines, "name: value" or "name = value": enough to see which
/// format it is of, whatever is wrong with the rest.
class TopLevel {
 public:
  explicit TopLevel(const std::string& text);

  bool has(const std::string& name) const { return values_.count(name) != 0; }
  /// As it stands in the line, without blanks around it; empty if there is none.
  std::string value(const std::string& name) const;
  /// The numbers, of three digits at most, of the names that have this beginning and then digits only,
  /// ascending.
  std::vector<int> numbers(const std::string& beginning) const;
  bool has_numbered(const std::string& beginning) const { return !numbers(beginning).empty(); }
  /// Whether a name stands here whose value begins like a number.
  bool has_number(const std::string& name) const;
  /// Whether the text begins as OpenCV's YAML, XML or JSON does.
  bool begins_as_file_storage() const { return file_storage_; }

 private:
  bool file_storage_ = false;
  std::map<std::string, std::string> values_;
};

}  // namespace parallax
