// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "platform/cosim/token_comparison.hpp"
#include "platform/cosim/token_words.hpp"

namespace parallax {

/// What explains all differences of a comparison, the most telling first; at least one, if only that nothing
/// known does. Each holds for every token, but for a rim or a few tokens if it says so, or for those of one
/// frame where none holds for all: tokens lost or doubled, late, moved or in another order; values whose
/// bits, bytes or fields are in another order, inverted, cut off or moved by a constant; a part of the image,
/// of the disparities or of the wires in which all of them lie.
std::vector<DifferencePattern> find_patterns(const TokenComparison& comparison, const TokenWords& expected,
                                             const TokenWords& got);

}  // namespace parallax
