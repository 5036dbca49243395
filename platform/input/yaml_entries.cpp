// SPDX-License-Identifier: Apache-2.0
#include "platform/input/yaml_entries.hpp"

#include <fmt/format.h>
#include <yaml-cpp/depthguard.h>

#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "platform/input/number_text.hpp"
#include "platform/input/quoted_text.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

// Line numbers stay as they are.
std::string without_opencv_head(std::string text) {
  if (text.compare(0, 5, "%YAML") == 0) text.erase(0, text.find('\n'));
  return text;
}

YAML::Node first_document(const CalibrationRequest::File& file) {
  try {
    return YAML::Load(without_opencv_head(file.text));
  } catch (const YAML::DeepRecursion& error) {
    throw UserError(
        fmt::format("{}: nested more than {} deep, such as no calibration is", file.path, error.depth()));
  } catch (const YAML::Exception& error) {
    throw UserError(
        fmt::format("{}: not YAML: line {}: {}", file.path, error.mark.line + 1, excerpt(error.msg)));
  }
}

double finite_number(const YAML::Node& node, const std::string& where) {
  if (!node.IsScalar()) throw UserError(where + " is not a number");
  const std::optional<double> value = number_of(node.Scalar());
  if (!value) throw UserError(fmt::format("{}: {} is not a number", where, in_quotes(node.Scalar())));
  if (!std::isfinite(*value)) throw UserError(where + " holds a value that is not a finite number");
  return *value;
}

// Of a list, or of its rows one after the other; `columns` 0: those may differ.
std::vector<double> flat_list(const YAML::Node& list, std::size_t columns, const std::string& where) {
  std::vector<double> values;
  for (const YAML::Node& element : list) {
    if (!element.IsSequence()) {
      values.push_back(finite_number(element, where));
      continue;
    }
    if (columns != 0 && element.size() != columns) {
      throw UserError(fmt::format("{} has a row of {} numbers, {} expected", where, element.size(), columns));
    }
    for (const YAML::Node& number : element) values.push_back(finite_number(number, where));
  }
  return values;
}

}  // namespace

YamlEntries::YamlEntries(const CalibrationRequest::File& file)
    : YamlEntries(first_document(file), file.path + ": ") {}

YamlEntries::YamlEntries(const YAML::Node& node, std::string where) : node_(node), where_(std::move(where)) {
  if (!node_.IsMap()) throw UserError(where_ + "no named entries");
  std::set<std::string> names;
  for (const auto& entry : node_) {
    if (entry.first.IsScalar() && !names.insert(entry.first.Scalar()).second) {
      throw UserError(fmt::format("{}{} occurs twice", where_, excerpt(entry.first.Scalar())));
    }
  }
}

YAML::Node YamlEntries::find(const std::string& name) const {
  for (const auto& entry : node_) {
    if (entry.first.IsScalar() && entry.first.Scalar() == name) return entry.second;
  }
  throw UserError(where(name) + " is missing");
}

bool YamlEntries::has(const std::string& name) const {
  for (const auto& entry : node_) {
    if (entry.first.IsScalar() && entry.first.Scalar() == name) return !entry.second.IsNull();
  }
  return false;
}

std::string YamlEntries::present(const Names& names) const {
  for (const std::string& name : names) {
    if (has(name)) return name;
  }
  return names.front();
}

YamlEntries YamlEntries::map(const std::string& name) const { return {find(name), where(name) + ": "}; }

std::string YamlEntries::text(const std::string& name) const {
  const YAML::Node node = find(name);
  if (!node.IsScalar()) throw UserError(where(name) + " is not a text");
  return node.Scalar();
}

double YamlEntries::number(const std::string& name) const { return finite_number(find(name), where(name)); }

std::vector<double> YamlEntries::numbers(const std::string& name) const {
  const YAML::Node node = find(name);
  if (node.IsSequence()) return flat_list(node, 0, where(name));
  if (!node.IsMap()) throw UserError(where(name) + " is not a list of numbers");
  const YamlEntries parts = map(name);
  std::vector<double> values = parts.numbers("data");
  if (parts.has("rows") && parts.has("cols")) {
    const double count = parts.number("rows") * parts.number("cols");
    if (count != static_cast<double>(values.size())) {
      throw UserError(fmt::format("{} has rows: {} and cols: {}, but {} numbers", where(name),
                                  parts.number("rows"), parts.number("cols"), values.size()));
    }
  }
  return values;
}

std::vector<double> YamlEntries::matrix(const std::string& name, int rows, int columns) const {
  const YAML::Node node = find(name);
  std::vector<double> values = node.IsSequence() ? flat_list(node, columns, where(name)) : numbers(name);
  if (values.size() != static_cast<std::size_t>(rows) * columns) {
    throw UserError(
        fmt::format("{} has {} numbers, {}x{} expected", where(name), values.size(), rows, columns));
  }
  return values;
}

}  // namespace parallax
