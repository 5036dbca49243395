// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "platform/cosim/token_comparison.hpp"
#include "platform/cosim/token_words.hpp"

namespace parallax {

/// In which part of the image, of the disparities or of the wires all differences lie.
struct DifferenceRegions {
  std::vector<DifferencePattern> patterns;
  bool is_small = false;  ///< at the border of the image, or in one row or column
};

/// Of differences that could as well lie everywhere, were they spread evenly, nothing is said.
DifferenceRegions find_regions(const TokenComparison& comparison, const TokenWords& expected,
                               const TokenWords& got);

}  // namespace parallax
