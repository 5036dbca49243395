// SPDX-License-Identifier: Apache-2.0
#include "modules/uniqueness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr int kOne = 256;         ///< q = 1
constexpr int kMaxFactor = 4096;  ///< q = 16

}  // namespace

void UniquenessConfig::validate() const {
  if (factor < kOne || factor > kMaxFactor) {
    throw UserError(fmt::format("uniqueness.factor = {}: must be within {}..{} (1/256 steps, 1 to 16)",
                                factor, kOne, kMaxFactor));
  }
}

Uniqueness::Uniqueness(const UniquenessConfig& config, DisparityRange range, int width, int /*height*/)
    : config_(config), range_(range), width_(width), row_(width) {
  config_.validate();
}

std::int64_t Uniqueness::storage_bits(int at_once) const {
  if (!config_.enabled) return 0;
  constexpr std::int64_t kCostBits = 16;
  constexpr std::int64_t kIndexBits = 8;
  return at_once * (config_.neighbours_are_rivals ? 2 : 4) * (kCostBits + kIndexBits);
}

bool Uniqueness::unique(const Cost* costs, int k) const {
  const int reach = config_.neighbours_are_rivals ? 0 : 1;
  const int below = std::max(k - reach, 0);
  const int above = std::min(k + reach + 1, range_.count);
  if (below == 0 && above == range_.count) return true;
  const Cost rival = std::min(lowest_cost(costs, below), lowest_cost(costs + above, range_.count - above));
  return costs[k] * config_.factor < rival * kOne;
}

void Uniqueness::push(const Cost* costs, const Disparity* disparities, const RowSink<Disparity>& emit) {
  std::copy_n(disparities, width_, row_.begin());
  if (config_.enabled) {
    for (int x = 0; x < width_; ++x) {
      Disparity& d = row_[x];
      if (d.valid() && !unique(costs + x * range_.count, integer_disparity(d) - range_.offset)) {
        d = {kInvalidDisparity, Cause::kUniqueness};
      }
    }
  }
  emit(row_.data());
}

}  // namespace parallax
