// SPDX-License-Identifier: Apache-2.0
#include "modules/cost_row.hpp"

#include <algorithm>
#include <cstddef>

#include "modules/area.hpp"

namespace parallax {
namespace {

std::uint8_t byte_of(CensusCode code, int index) { return static_cast<std::uint8_t>(code >> (8 * index)); }

/// out[i] (+)= number of bits in which code and others[i] differ; bytewise, because baseline x86-64 has no
/// instruction that counts bits.
template <bool kAdd>
void count_differences(std::uint8_t code, const std::uint8_t* __restrict others, int n,
                       std::uint8_t* __restrict out) {
  for (int i = 0; i < n; ++i) {
    auto v = static_cast<std::uint8_t>(code ^ others[i]);
    v = v - ((v >> 1) & 0x55);
    v = (v & 0x33) + ((v >> 2) & 0x33);
    v = (v + (v >> 4)) & 0x0F;
    out[i] = kAdd ? out[i] + v : v;
  }
}

void absolute_differences(std::uint8_t grey, const std::uint8_t* __restrict others, int n,
                          std::uint8_t* __restrict out) {
  for (int i = 0; i < n; ++i) {
    out[i] = static_cast<std::uint8_t>(std::max(grey, others[i]) - std::min(grey, others[i]));
  }
}

}  // namespace

CostRow::CostRow(const MatchingConfig& config, int width, int code_bits)
    : range_(config.range()),
      cost_(config.cost),
      outside_(config.outside_cost),
      width_(width),
      outside_value_(static_cast<std::uint8_t>(
          outside_ == OutsideCost::kValue ? config.outside_value : config.largest_cost(code_bits))),
      weight_(static_cast<std::uint8_t>(config.weight())),
      planes_((code_bits + 7) / 8),
      plane_size_(width + range_.last()) {
  right_.resize(area(planes_, plane_size_));
}

void CostRow::compute(const CensusCode* left, const CensusCode* right, const CensusCode* before,
                      std::uint8_t* costs) {
  const CensusCode outside = outside_ == OutsideCost::kReplicate ? right[0] : CensusCode{0};
  for (int plane = 0; plane < planes_; ++plane) {
    std::uint8_t* out = right_.data() + plane * plane_size_;
    for (int x = 0; x < width_; ++x) out[width_ - 1 - x] = byte_of(right[x], plane);
    std::fill(out + width_, out + plane_size_, byte_of(outside, plane));
    const std::size_t known = reach();
    for (std::size_t i = 0; i < known; ++i) out[width_ + i] = byte_of(before[known - 1 - i], plane);
  }
  const int count = range_.count;
  for (int x = 0; x < width_; ++x, costs += count) {
    const std::uint8_t* first = right_.data() + (width_ - 1 - x + range_.offset);
    if (cost_ == MatchingCost::kAbsoluteDifference) {
      absolute_differences(byte_of(left[x], 0), first, count, costs);
    } else {
      count_differences<false>(byte_of(left[x], 0), first, count, costs);
      for (int plane = 1; plane < planes_; ++plane) {
        count_differences<true>(byte_of(left[x], plane), first + plane * plane_size_, count, costs);
      }
    }
    if (weight_ != 1) {
      for (int k = 0; k < count; ++k) costs[k] = costs[k] * weight_;
    }
    if (outside_ == OutsideCost::kMaximum || outside_ == OutsideCost::kValue) {
      const int inside = std::clamp(x - range_.offset + 1, 0, count);
      std::fill(costs + inside, costs + count, outside_value_);
    }
  }
}

}  // namespace parallax
