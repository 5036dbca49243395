// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/point_rules.hpp"

#include <fmt/format.h>

#include <cstddef>
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

PointRules::PointRules(const ExplorationSpec& spec) : names_(spec.varied_names()) {
  // A link may use those before it.
  std::vector<std::string> known(names_.begin(),
                                 names_.end() - static_cast<std::ptrdiff_t>(spec.links.size()));
  for (const LinkedKey& link : spec.links) {
    links_.emplace_back(link.expression, known, link.origin);
    known.push_back(link.key);
  }
  for (const Condition& condition : spec.conditions)
    conditions_.emplace_back(condition.expression, names_, condition.origin);
}

bool PointRules::complete(std::vector<std::string>& values) {
  if (links_.empty() && conditions_.empty()) return true;
  std::vector<ConfigValue> known;
  for (const std::string& text : values) known.push_back(as_value(text));
  for (Expression& link : links_) {
    try {
      known.push_back(link.value(known));
    } catch (const UserError& error) {
      std::string where;
      for (std::size_t i = 0; i < values.size(); ++i)
        where += fmt::format("{}{} = {}", i == 0 ? "" : ", ", names_[i], values[i]);
      throw UserError(fmt::format("{} where {}", error.what(), where));
    }
    values.push_back(as_text(known.back()));
  }
  for (Expression& condition : conditions_) {
    if (!condition.holds(known)) return false;
  }
  return true;
}

}  // namespace parallax
