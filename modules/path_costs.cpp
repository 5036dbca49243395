// SPDX-License-Identifier: Apache-2.0
#include "modules/path_costs.hpp"

#include <algorithm>

#include "modules/area.hpp"

namespace parallax {
namespace {

/// Above every path cost, and no overflow when a penalty (at most 255) is added.
constexpr std::int16_t kNever = 0x3FFF;
constexpr int kNoColumn = -1;
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

Path::Path(Direction direction, const MatchingConfig& config, int width)
    : direction_(direction),
      start_(config.path_start),
      restart_column_(start_ == PathStart::kFirstColumn ? 0 : kNoColumn),
      count_(config.range().count),
      p1_(static_cast<std::int16_t>(config.p1)),
      p2_(static_cast<std::int16_t>(config.p2)),
      narrow_(config.path_bits != 0 && config.path_bits < kBitsOfEveryPathCost),
      overflow_(config.path_overflow),
      largest_(static_cast<std::int16_t>(narrow_ ? (1 << config.path_bits) - 1 : kNever)),
      width_(width),
      slots_(direction.rows_up == 0 ? 2 : width + 2) {
  costs_.assign(area(slots_, count_ + PathCosts::kGuard) + PathCosts::kGuard, kNever);
  minima_.resize(slots_);
}

PathCosts Path::slot(int position) {
  const auto i = position % slots_;
  return {costs_.data() + i * (count_ + PathCosts::kGuard) + PathCosts::kGuard, minima_.data() + i};
}

int Path::predecessor(int x, int y) const {
  const int from_x = x + direction_.dx;
  const int from_y = y - direction_.rows_up;
  const int here = y * width_ + x;
  const int there = from_y * width_ + from_x;
  if (x == restart_column_) return -1;
  if (from_x >= 0 && from_x < width_) return there;
  const bool horizontal = direction_.rows_up == 0;
  switch (start_) {
    case PathStart::kCost:
      return -1;
    case PathStart::kClamp:
      return horizontal ? -1 : here - width_;
    case PathStart::kCarry:
      return horizontal ? there : -1;
    case PathStart::kDelayLine:
    case PathStart::kFirstColumn:
      return there < here ? there : -1;
  }
  return -1;
}

inline void Path::step(int x, int y, const std::uint8_t* costs, Cost* sums) {
  const PathCosts here = slot(y * width_ + x);
  const int before = predecessor(x, y);
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
