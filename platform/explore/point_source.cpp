// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/point_source.hpp"

#include <fmt/format.h>

#include <utility>

#include "platform/config/preset_file.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

// Of a random sample: so many draws for each point that is wanted, at most.
constexpr std::size_t kDrawsAPoint = 1000;

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

PointSource::PointSource(const ExplorationSpec& spec) : spec_(spec), sampling_(spec.axes, spec.sampling) {
  names_ = spec.varied_names();
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

std::optional<ExplorationPoint> PointSource::next() {
  const std::size_t wanted = spec_.sampling.points;
  while (wanted == 0 || found_ < wanted) {
    std::optional<std::vector<std::string>> values = sampling_.next();
    if (!values) return std::nullopt;
    ++drawn_;
    if (fulfils_conditions(*values)) return ExplorationPoint{found_++, std::move(*values)};
    if (wanted != 0 && drawn_ >= wanted * kDrawsAPoint) {
      throw UserError(
          fmt::format("{}: the conditions leave {} of {} points that were drawn; {} were asked for",
                      spec_.conditions.front().origin, found_, drawn_, wanted));
    }
  }
  return std::nullopt;
}

// Adds what follows from the values first.
bool PointSource::fulfils_conditions(std::vector<std::string>& values) {
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

std::size_t count_points(const ExplorationSpec& spec, std::size_t most) {
  PointSource source(spec);
  std::size_t number = 0;
  while (source.next()) {
    if (++number > most) throw UserError(fmt::format("more than {} points", most));
  }
  return number;
}

std::vector<std::string> assignments_of(const ExplorationSpec& spec, const ExplorationPoint& point) {
  const std::vector<std::string> names = spec.varied_names();
  std::vector<std::string> all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i >= spec.axes.size() || !spec.axes[i].option) all.push_back(names[i] + "=" + point.values[i]);
  }
  return all;
}

std::vector<RunWord> run_words_of(const ExplorationSpec& spec, const ExplorationPoint& point) {
  std::vector<RunWord> all;
  for (std::size_t i = 0; i < spec.axes.size(); ++i) {
    if (spec.axes[i].option) all.push_back({spec.axes[i].name, {point.values[i]}});
  }
  return all;
}

}  // namespace parallax
