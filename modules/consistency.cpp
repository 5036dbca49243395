// SPDX-License-Identifier: Apache-2.0
#include "modules/consistency.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>

#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr int kMaxThreshold = 15;

/// One left pixel offers its costs to `count` right pixels.
template <class Better>
void offer(const Cost* __restrict costs, int count, Cost* __restrict lowest, std::uint16_t* __restrict index,
           Better better) {
  for (int k = 0; k < count; ++k) {
    const bool take = better(costs[k], lowest[k]);
    index[k] = take ? static_cast<std::uint16_t>(k) : index[k];
    lowest[k] = take ? costs[k] : lowest[k];
  }
}

}  // namespace

void ConsistencyConfig::validate() const {
  if (threshold < 0 || threshold > kMaxThreshold) {
    throw UserError(
        fmt::format("consistency.threshold = {}: must be within 0..{} px", threshold, kMaxThreshold));
  }
}

Consistency::Consistency(const ConsistencyConfig& config, DisparityRange range, int width, int /*height*/)
    : config_(config),
      range_(range),
      width_(width),
      right_lowest_(width + range.last()),
      right_index_(right_lowest_.size()),
      row_(width) {
  config_.validate();
}

std::int64_t Consistency::storage_bits(int at_once) const {
  if (!config_.enabled) return 0;
  constexpr std::int64_t kRightPixelBits = 16 + 8;  // cost and disparity
  return at_once * (kRightPixelBits * range_.count + kDisparityBits * look_ahead_pixels());
}

void Consistency::match_right(const Cost* costs) {
  std::fill(right_lowest_.begin(), right_lowest_.end(), Cost{0xFFFF});
  std::fill(right_index_.begin(), right_index_.end(), std::uint16_t{0});
  // Left to right, so that a right pixel sees its disparities in ascending order.
  for (int x = 0; x < width_; ++x, costs += range_.count) {
    const int first = width_ - 1 - x + range_.offset;
    if (config_.right_winner == TieRule::kLowest) {
      offer(costs, range_.count, right_lowest_.data() + first, right_index_.data() + first,
            [](Cost a, Cost b) { return a < b; });
    } else {
      offer(costs, range_.count, right_lowest_.data() + first, right_index_.data() + first,
            [](Cost a, Cost b) { return a <= b; });
    }
  }
}

void Consistency::push(const Cost* costs, const Disparity* disparities, const RowSink<Disparity>& emit) {
  std::copy_n(disparities, width_, row_.begin());
  if (config_.enabled) {
    match_right(costs);
    for (int x = 0; x < width_; ++x) {
      Disparity& left = row_[x];
      if (!left.valid()) continue;
      const int d_left = integer_disparity(left);
      const int u = x - d_left;
      bool keep = config_.outside_match == OutsideMatch::kKeep;
      if (u >= 0) {
        const int d_right = range_.offset + right_index_[width_ - 1 - u];
        keep = std::abs(d_left - d_right) <= config_.threshold;
      }
      if (!keep) left = {kInvalidDisparity, Cause::kConsistency};
    }
  }
  emit(row_.data());
}

}  // namespace parallax
