// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/axis_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "platform/explore/value_range.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr std::size_t kMostValues = 100'000;

std::vector<std::string> range(const TomlPart& entry, const std::string& text) {
  try {
    return range_values(text, kMostValues);
  } catch (const UserError& error) {
    entry.fail(error.what());
  }
}

std::vector<std::string> listed(const TomlPart& entry, bool numbers) {
  std::vector<std::string> all;
  for (const std::string& value : entry.values()) {
    if (!numbers || value.find(':') == std::string::npos) {
      all.push_back(value);
      continue;
    }
    for (std::string& number : range(entry, value)) all.push_back(std::move(number));
  }
  if (all.empty()) entry.fail("has no values");
  return all;
}

struct Table {
  std::optional<TomlPart> from, to, step, factor, scale;
};

Table table_of(const TomlPart& entry) {
  Table table;
  for (const TomlPart& part : entry.entries()) {
    std::optional<TomlPart>* const place = part.name == "from"     ? &table.from
                                           : part.name == "to"     ? &table.to
                                           : part.name == "step"   ? &table.step
                                           : part.name == "factor" ? &table.factor
                                           : part.name == "scale"  ? &table.scale
                                                                   : nullptr;
    if (place == nullptr) part.fail("unknown; it may have from, to, step, factor and scale");
    *place = part;
  }
  if (!table.from || !table.to) entry.fail("from and to are both needed");
  if (table.step.has_value() + table.factor.has_value() + table.scale.has_value() > 1)
    entry.fail("has one of step, factor and scale");
  return table;
}

bool is_logarithmic(const TomlPart& scale) {
  const std::string name = scale.text();
  if (name != "linear" && name != "log") scale.fail("must be \"linear\" or \"log\"");
  return name == "log";
}

Axis between(const TomlPart& entry, const Key& key) {
  const Table table = table_of(entry);
  Axis axis{entry.name, false, {}, {}};
  if (table.step) {
    axis.values =
        range(entry, fmt::format("{}:{}:{}", table.from->value(), table.to->value(), table.step->value()));
    return axis;
  }
  const double least = table.from->number();
  const double most = table.to->number();
  const bool whole = key.type == KeyType::kInteger;
  if (least >= most) entry.fail("from must be below to");
  const bool logarithmic = table.factor || (table.scale && is_logarithmic(*table.scale));
  if (logarithmic && least <= 0) entry.fail("from must be above 0 where each value is a multiple of another");
  if (!table.factor) {
    axis.span = Span{least, most, logarithmic, whole};
    return axis;
  }
  if (table.factor->number() <= 1) table.factor->fail("must be above 1");
  axis.values = logarithmic_values(least, most, table.factor->number(), whole);
  return axis;
}

}  // namespace

Axis read_axis(const TomlPart& entry, const Key* key) {
  const bool numbers = key != nullptr && (key->type == KeyType::kInteger || key->type == KeyType::kReal);
  if (!entry.node->is_table()) {
    return {entry.name, key == nullptr, listed(entry, numbers || entry.name == "disparities"), {}};
  }
  if (!numbers) entry.fail("from and to are for keys that are numbers; list the values");
  return between(entry, *key);
}

}  // namespace parallax
