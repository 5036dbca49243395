// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/vary_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "traces/metric_text.hpp"
#include "traces/number_text.hpp"

namespace parallax {
namespace {

constexpr std::size_t kGainsShown = 3;

// "core_clock +38.1 %; software +4.69 %": what limits, and what else gains alone.
std::string gains(const RelaxedLimits& limits) {
  std::vector<const RelaxedLimit*> shown;
  if (limits.limit) shown.push_back(&*limits.limit);
  for (const RelaxedLimit& limit : limits.alone) {
    const bool named = limits.limit && limit.relaxation.name == limits.limit->relaxation.name;
    if (limit.gains() && !named) shown.push_back(&limit);
  }
  if (shown.empty()) return "none";
  std::string text;
  for (std::size_t i = 0; i < std::min(shown.size(), kGainsShown); ++i)
    text += fmt::format("{}{} {} %", i == 0 ? "" : "; ", shown[i]->relaxation.name,
                        change_text(shown[i]->gain, "%"));
  return text;
}

}  // namespace

VaryTable::VaryTable(const VaryGrid& grid, const RunOptions& options)
    : grid_(grid),
      // Who varies the parallelism varies the range, unless it is given.
      range_varies_(!options.configuration.disparity_range && !grid.varies("disparities") &&
                    (grid.varies("matching.parallelism") || grid.varies("matching.iterations") ||
                     grid.varies("preset"))),
      relaxed_(options.relax) {
  for (const VaryAxis& axis : grid.axes()) {
    std::size_t most = axis.name.size();
    for (const std::string& text : axis.values) most = std::max(most, text.size());
    widths_.push_back(most);
  }
}

std::string VaryTable::header() const {
  std::string line = "point";
  for (std::size_t i = 0; i < widths_.size(); ++i)
    line += fmt::format("  {:>{}}", grid_.axes()[i].name, widths_[i]);
  if (range_varies_) line += "  disparities";
  return line + "   frame rate      latency  limit" + (relaxed_ ? ", and what taking it away gains\n" : "\n");
}

std::string VaryTable::row(std::size_t point, const EvaluationResult& result,
                           const RelaxedLimits* limits) const {
  std::string line = fmt::format("{:>5}", point);
  for (std::size_t i = 0; i < widths_.size(); ++i)
    line += fmt::format("  {:>{}}", grid_.value(point, i), widths_[i]);
  if (!result.done()) return line + fmt::format("  {}: {}\n", name(result.status), result.advice());
  if (range_varies_) line += fmt::format("  {:>11}", result.disparities);
  if (result.rate == 0) return line + "  one frame has no rate\n";
  const MetricGroup& metrics = result.metrics;
  line += fmt::format("  {:>11}  {:>11}  ", metric_text(metrics.at("performance/frame_rate")),
                      metric_text(metrics.at("latency/exposure_to_host_mean")));
  if (limits != nullptr) return line + gains(*limits) + "\n";
  // Where no part limits, the utilisation is that of the busiest one.
  return line + filled_in(metrics, metrics.word("limit/part") == "none"
                                       ? "none; {limit/next_part} at {limit/utilisation}\n"
                                       : "{limit/part} at {limit/utilisation}\n");
}

}  // namespace parallax
