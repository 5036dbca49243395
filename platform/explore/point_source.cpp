// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/point_source.hpp"

#include <fmt/format.h>

#include <utility>

#include "tlm/error.hpp"

namespace parallax {
namespace {

// Of a random sample: so many draws for each point that is wanted, at most.
constexpr std::size_t kDrawsAPoint = 1000;

}  // namespace

PointSource::PointSource(const ExplorationSpec& spec)
    : spec_(spec), sampling_(spec.axes, spec.sampling), rules_(spec) {}

std::optional<ExplorationPoint> PointSource::next() {
  const std::size_t wanted = spec_.sampling.points;
  while (wanted == 0 || found_ < wanted) {
    std::optional<std::vector<std::string>> values = sampling_.next();
    if (!values) return std::nullopt;
    ++drawn_;
    if (rules_.complete(*values)) return ExplorationPoint{found_++, std::move(*values)};
    if (wanted != 0 && drawn_ >= wanted * kDrawsAPoint) {
      throw UserError(
          fmt::format("{}: the conditions leave {} of {} points that were drawn; {} were asked for",
                      spec_.conditions.front().origin, found_, drawn_, wanted));
    }
  }
  return std::nullopt;
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
