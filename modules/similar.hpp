// SPDX-License-Identifier: Apache-2.0
// Comparison of disparities by filters that look at a window.
#pragma once

#include <cstdint>

#include "modules/pixel.hpp"

namespace parallax {

/// Stands for an invalid pixel in rows of plain values: far from each valid disparity by more than any
/// threshold.
inline constexpr std::uint16_t kSimilarToNone = 0x7FFF;

/// Highest threshold: no two valid disparities differ by more.
inline constexpr int kMaxDisparityDifference = kInvalidDisparity - 1;

/// True if `other` differs from the valid disparity `centre` by at most max_difference; false for
/// kSimilarToNone. One subtraction and one comparison modulo 2^16, which a compiler turns into vector code.
inline bool similar(std::uint16_t centre, std::uint16_t other, std::uint16_t max_difference) {
  return static_cast<std::uint16_t>(other - centre + max_difference) <=
         static_cast<std::uint16_t>(2 * max_difference);
}

inline void comparable_values(const Disparity* row, int width, std::uint16_t* values) {
  for (int x = 0; x < width; ++x) values[x] = row[x].valid() ? row[x].value : kSimilarToNone;
}

}  // namespace parallax
