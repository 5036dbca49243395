// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/axis_effect.hpp"

#include <algorithm>
#include <optional>

#include "platform/explore/merit.hpp"

namespace parallax {
namespace {

void take(AxisEffect& kept, double number, const std::string& value) {
  if (number < kept.least) {
    kept.least = number;
    kept.at_least = value;
  }
  if (number > kept.most) {
    kept.most = number;
    kept.at_most = value;
  }
}

// Which axis alone has another value than the base.
std::optional<std::size_t> axis_of(const ExplorationSpec& spec, const StoredPoint& point) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < spec.axes.size(); ++i) {
    if (point.values[i] == spec.axes[i].values.front()) continue;
    if (found) return std::nullopt;
    found = i;
  }
  return found;
}

bool is_base(const ExplorationSpec& spec, const StoredPoint& point) {
  for (std::size_t i = 0; i < spec.axes.size(); ++i) {
    if (point.values[i] != spec.axes[i].values.front()) return false;
  }
  return true;
}

}  // namespace

std::vector<AxisEffect> axis_effects(const ExplorationSpec& spec, ResultStore& store,
                                     const std::vector<std::string>& metrics) {
  const PointNumbers numbers(spec);
  std::vector<AxisEffect> all;  // by metric, then by axis; empty before the base
  std::vector<bool> known(metrics.size());
  store.each_point(metrics, [&](const StoredPoint& point) {
    if (point.result.status != "done") return;
    if (is_base(spec, point)) {
      for (std::size_t metric = 0; metric < metrics.size(); ++metric) {
        const std::optional<double> base = numbers.of(point, metrics[metric]);
        known[metric] = base.has_value();
        for (const Axis& axis : spec.axes) {
          const std::string& first = axis.values.front();
          const double number = base.value_or(0);
          all.push_back({axis.name, metrics[metric], number, number, first, number, first});
        }
      }
      return;
    }
    const std::optional<std::size_t> axis = axis_of(spec, point);
    if (!axis || all.empty()) return;
    for (std::size_t metric = 0; metric < metrics.size(); ++metric) {
      const std::optional<double> number = numbers.of(point, metrics[metric]);
      if (number) take(all[metric * spec.axes.size() + *axis], *number, point.values[*axis]);
    }
  });
  std::vector<AxisEffect> sorted;
  for (std::size_t metric = 0; metric < metrics.size() && !all.empty(); ++metric) {
    if (!known[metric]) continue;
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(metric * spec.axes.size());
    const auto last = first + static_cast<std::ptrdiff_t>(spec.axes.size());
    std::stable_sort(first, last,
                     [](const AxisEffect& a, const AxisEffect& b) { return a.range() > b.range(); });
    sorted.insert(sorted.end(), first, last);
  }
  return sorted;
}

}  // namespace parallax
