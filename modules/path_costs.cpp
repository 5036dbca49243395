// SPDX-License-Identifier: Apache-2.0
#include "modules/path_costs.hpp"

#include <algorithm>

#include "modules/area.hpp"

namespace parallax {
namespace {

/// Above every path cost, and no overflow when a penalty (at most 255) is added.
constexpr std::int16_t kNever = 0x3FFF;
constexpr int kBitsOfEveryPathCost = 9;  // at most 510

std::int16_t min16(std::int16_t a, std::int16_t b) { return a < b ? a : b; }
std::int16_t add16(std::int16_t a, std::int16_t b) { return static_cast<std::int16_t>(a + b); }

std::int16_t start_path(const std::uint8_t* __restrict costs, int count, std::int16_t* __restrict out,
                        Cost* __restrict sums) {
  std::int16_t minimum = kNever;
  for (int k = 0; k < count; ++k) {
    const std::int16_t cost = costs[k];
    out[k] = cost;
    sums[k] = static_cast<Cost>(sums[k] + cost);
    minimum = min16(minimum, cost);
  }
  return minimum;
}

std::int16_t continue_path(const std::uint8_t* __restrict costs, int count,
                           const std::int16_t* __restrict before, std::int16_t before_minimum,
                           std::int16_t p1, std::int16_t p2, std::int16_t* __restrict out,
                           Cost* __restrict sums) {
  const std::int16_t jump = add16(before_minimum, p2);
  const auto lower = static_cast<std::int16_t>(-before_minimum);
  std::int16_t minimum = kNever;
  for (int k = 0; k < count; ++k) {
    const std::int16_t step = add16(min16(before[k - 1], before[k + 1]), p1);
    const std::int16_t best = min16(min16(before[k], jump), step);
    const std::int16_t cost = add16(add16(best, lower), costs[k]);
    out[k] = cost;
    sums[k] = static_cast<Cost>(sums[k] + cost);
    minimum = min16(minimum, cost);
  }
  return minimum;
}

}  // namespace

PathStep path_step(const MatchingConfig& config, PathBit path) {
  const auto is = [path](unsigned paths) { return (path & paths) != 0 ? 1 : 0; };
  const int dx = is(kPathNE | kPathE | kPathSE) - is(kPathW | kPathNW | kPathSW);
  const bool from_left = path_order(path) == ScanOrder::kRaster;
  return {from_left ? dx : -dx, 1 - is(kPathW | kPathE),
          path == kPathE ? PathStart::kCost : config.path_start};
}

Path::Path(PathBit bit, const MatchingConfig& config, int width, bool whole_row)
    : bit_(bit),
      step_(path_step(config, bit)),
      count_(config.range().count),
      p1_(static_cast<std::int16_t>(config.p1)),
      p2_(static_cast<std::int16_t>(config.p2)),
      narrow_(config.path_bits != 0 && config.path_bits < kBitsOfEveryPathCost),
      overflow_(config.path_overflow),
      largest_(static_cast<std::int16_t>(narrow_ ? (1 << config.path_bits) - 1 : kNever)),
      width_(width),
      slots_(step_.rows_up == 0 && !whole_row ? 2 : width + 2) {
  costs_.assign(area(slots_, count_ + PathCosts::kGuard) + PathCosts::kGuard, kNever);
  minima_.resize(slots_);
}

PathCosts Path::slot(int position) {
  const auto i = position % slots_;
  return {costs_.data() + i * (count_ + PathCosts::kGuard) + PathCosts::kGuard, minima_.data() + i};
}

inline void Path::step(int x, int y, const std::uint8_t* costs, Cost* sums) {
  const PathCosts here = slot(y * width_ + x);
  const int before = step_.predecessor(x, y, width_);
  if (before < 0) {
    *here.minimum = start_path(costs, count_, here.costs, sums);
  } else {
    const PathCosts from = slot(before);
    *here.minimum = continue_path(costs, count_, from.costs, *from.minimum, p1_, p2_, here.costs, sums);
  }
}

// The narrow registers stand apart so that the whole ones cost no more for them.
void Path::advance(int x, int y, const std::uint8_t* costs, Cost* sums) {
  if (narrow_) return advance_narrow(x, y, costs, sums);
  step(x, y, costs, sums);
}

void Path::advance_narrow(int x, int y, const std::uint8_t* costs, Cost* sums) {
  step(x, y, costs, sums);
  narrow(slot(y * width_ + x), sums);
}

// What does not fit comes back out of the sums, too.
void Path::narrow(const PathCosts& here, Cost* sums) const {
  *here.minimum = kNever;
  for (int k = 0; k < count_; ++k) {
    const std::int16_t whole = here.costs[k];
    const auto kept = overflow_ == PathOverflow::kSaturate ? min16(whole, largest_)
                                                           : static_cast<std::int16_t>(whole & largest_);
    here.costs[k] = kept;
    sums[k] = static_cast<Cost>(sums[k] - (whole - kept));
    *here.minimum = min16(*here.minimum, kept);
  }
}

}  // namespace parallax
