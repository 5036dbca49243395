// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/point_rules.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <variant>

#include "platform/config/preset_file.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

ConfigValue as_value(const std::string& text) {
  const RawValue raw = read_assignment("value=" + text).second;
  if (const auto* value = std::get_if<ConfigValue>(&raw.value)) return *value;
  return text;
}

std::string as_text(const ConfigValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return to_toml(value);
}

}  // namespace

PointRules::PointRules(const ExplorationSpec& spec) : spec_(spec) {
  std::vector<std::string> known;
  for (const std::string& assignment : spec.assignments) {
    const std::size_t equals = assignment.find('=');
    known.push_back(assignment.substr(0, equals));
    constants_.push_back(as_value(assignment.substr(equals + 1)));
  }
  for (const Axis& axis : spec.axes) known.push_back(axis.name);
  // A link may use those before it.
  for (const LinkedKey& link : spec.links) {
    links_.emplace_back(link.expression, known, link.origin);
    known.push_back(link.key);
  }
  for (const Condition& condition : spec.conditions)
    conditions_.emplace_back(condition.expression, known, condition.origin);
}

bool PointRules::complete(std::vector<std::string>& values) {
  if (links_.empty() && conditions_.empty()) return true;
  std::vector<ConfigValue> known = constants_;
  for (const std::string& text : values) known.push_back(as_value(text));
  for (std::size_t i = 0; i < links_.size(); ++i) {
    known.push_back(linked_value(i, known, values));
    values.push_back(as_text(known.back()));
  }
  for (Expression& condition : conditions_) {
    if (!condition.holds(known)) return false;
  }
  return true;
}

ConfigValue PointRules::linked_value(std::size_t link, const std::vector<ConfigValue>& known,
                                     const std::vector<std::string>& values) {
  const LinkedKey& linked = spec_.links[link];
  try {
    ConfigValue value = links_[link].value(known);
    // A comparison gives 1 or 0.
    const auto* const whole = std::get_if<std::int64_t>(&value);
    if (linked.truth && whole != nullptr && (*whole == 0 || *whole == 1)) return *whole == 1;
    return value;
  } catch (const UserError& error) {
    const std::vector<std::string> names = spec_.varied_names();
    std::string where;
    for (std::size_t i = 0; i < values.size(); ++i)
      where += fmt::format("{}{} = {}", i == 0 ? "" : ", ", names[i], values[i]);
    throw UserError(fmt::format("{}, for {}, where {}", error.what(), linked.key, where));
  }
}

}  // namespace parallax
