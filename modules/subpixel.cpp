// SPDX-License-Identifier: Apache-2.0
#include "modules/subpixel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>

#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr int kHalf = 1 << (kDisparityFractionBits - 1);
constexpr int kMaxBorder = 31;

void check_border(const char* key, int value) {
  if (value < 0 || value > kMaxBorder) {
    throw UserError(fmt::format("subpixel.{} = {}: must be within 0..{}", key, value, kMaxBorder));
  }
}

/// Index of the first (or last) of n costs that equals `lowest`, which is among them. Looks at blocks first,
/// because "is it in here" vectorises and "where is it" does not.
int find(const Cost* costs, int n, Cost lowest, TieRule rule) {
  constexpr int kBlock = 32;
  if (rule == TieRule::kHighest) {
    int k = n - 1;
    while (costs[k] != lowest) --k;
    return k;
  }
  int k = 0;
  for (; k + kBlock <= n; k += kBlock) {
    Cost found = 0;
    for (int i = 0; i < kBlock; ++i) found |= costs[k + i] == lowest ? Cost{1} : Cost{0};
    if (found) break;
  }
  while (costs[k] != lowest) ++k;
  return k;
}

}  // namespace

void SubpixelConfig::validate() const {
  check_border("border_width", border_width);
  check_border("border_height", border_height);
}

Subpixel::Subpixel(const SubpixelConfig& config, DisparityRange range, int width, int height)
    : config_(config), range_(range), width_(width), height_(height), row_(width) {
  config_.validate();
}

std::int64_t Subpixel::storage_bits(int at_once) const {
  constexpr std::int64_t kCostBits = 16;
  constexpr std::int64_t kIndexBits = 8;
  return at_once * (4 * kCostBits + kIndexBits);
}

void Subpixel::push(const Cost* costs, const RowSink<Disparity>& emit) {
  const int dx = config_.mask_border ? config_.border_width : 0;
  const int dy = config_.mask_border ? config_.border_height : 0;
  const bool masked_row = next_row_ < dy || next_row_ >= height_ - dy;
  for (int x = 0; x < width_; ++x) {
    const bool masked = masked_row || x < dx || x >= width_ - dx;
    row_[x] = masked ? Disparity{kInvalidDisparity, Cause::kBorder} : refine(costs + x * range_.count);
  }
  next_row_ = next_row_ + 1 == height_ ? 0 : next_row_ + 1;
  emit(row_.data());
}

Disparity Subpixel::refine(const Cost* costs) const {
  const int k = find(costs, range_.count, lowest_cost(costs, range_.count), config_.winner);
  int value = (range_.offset + k) << kDisparityFractionBits;
  if (k > 0 && k + 1 < range_.count) value += fraction(costs[k - 1], costs[k], costs[k + 1]);
  return {static_cast<std::uint16_t>(value), Cause::kMatched};
}

int Subpixel::fraction(int below, int best, int above) const {
  if (config_.curve == SubpixelCurve::kNone) return 0;
  const int n = kHalf * (below - above);
  const int m =
      config_.curve == SubpixelCurve::kParabola ? below - 2 * best + above : std::max(below, above) - best;
  if (m == 0) return 0;
  if (config_.rounding == SubpixelRounding::kTruncate) return n / m;
  const int size = std::abs(n);
  const int limit = size < kHalf * m ? kHalf - 1 : kHalf;
  const int rounded = std::min((2 * size + m) / (2 * m), limit);
  return n < 0 ? -rounded : rounded;
}

}  // namespace parallax
