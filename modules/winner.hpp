// SPDX-License-Identifier: Apache-2.0
// What the stages behind the matcher agree on: the searched range, ties, and the integer part of a disparity.
#pragma once

#include <cstdint>

#include "modules/pixel.hpp"

namespace parallax {

/// How the costs of a token of pixels lie in tokens of costs. A pixel's costs are n_i groups of p; a circuit
/// that works on several rows at once has a group of each of them in a token.
struct CostGroups {
  std::uint32_t of_token = 1;  ///< tokens of costs for one of pixels
  int rows = 1;                ///< groups in a token of costs
};

/// The searched disparities: offset, offset + 1, ... offset + count - 1 (px). A row of costs holds `count`
/// values a pixel, pixel by pixel; value k belongs to the disparity offset + k.
struct DisparityRange {
  int offset = 0;
  int count = 128;

  /// d_max = o_d + n_i * p - 1 (paper, section "Stereo Matching").
  int last() const { return offset + count - 1; }
};

/// Which of several equally cheap disparities wins.
enum class TieRule { kLowest, kHighest };

/// Lowest of n costs; 0xFFFF if there is none.
inline Cost lowest_cost(const Cost* costs, int n) {
  // Compared as signed numbers, because baseline x86-64 has a minimum of those only.
  constexpr int kFlip = 0x8000;
  std::int16_t lowest = 0x7FFF;
  for (int k = 0; k < n; ++k) {
    const auto cost = static_cast<std::int16_t>(costs[k] ^ kFlip);
    lowest = cost < lowest ? cost : lowest;
  }
  return static_cast<Cost>(lowest ^ kFlip);
}

/// The integer disparity (px) behind a valid 8.4 value: the nearest integer, and the lower one of two equally
/// near. Subpixel refinement moves a winner by less than half a pixel, or by exactly half a pixel if and only
/// if it ties with its neighbour; so this recovers the winner, or (TieRule::kHighest) the lower one of two
/// neighbours that tie.
inline int integer_disparity(Disparity d) { return (d.value + 7) >> kDisparityFractionBits; }

}  // namespace parallax
