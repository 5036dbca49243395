// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/vary_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace parallax {
namespace {

constexpr std::size_t kGainsShown = 3;

// "core_clock +38.08 %; software +4.69 %": what limits, and what else gains alone.
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
    text += fmt::format("{}{} {:+.2f} %", i == 0 ? "" : "; ", shown[i]->relaxation.name, shown[i]->gain);
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
  line += fmt::format("  {:>7.2f} fps  {:>8.3f} ms  ", result.rate, result.latency.exposure_to_host);
  if (limits != nullptr) return line + gains(*limits) + "\n";
  return line + fmt::format("{} at {:.1f} %\n", result.limit.part, result.limit.utilisation);
}

}  // namespace parallax
