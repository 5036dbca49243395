// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "platform/cosim/token_comparison.hpp"
#include "platform/cosim/token_words.hpp"

namespace parallax {

/// Whether values in another order or shape (bits in any order, inverted, scaled by a power of two, 1 too
/// high or low) that are some tokens late or early (8, or a row, at most) explain the differences: all of
/// them, all but those in a rim (16 px, or a quarter of the image, at most), or all but a few tokens (fewer
/// than 1 in 100, and than 1 in 10 of those that differ). A pattern for each of the two that is; what is left
/// is told with the last.
std::vector<DifferencePattern> find_joint_patterns(const TokenComparison& comparison,
                                                   const TokenWords& expected, const TokenWords& got);

}  // namespace parallax
