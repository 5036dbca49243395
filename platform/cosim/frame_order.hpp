// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "platform/cosim/token_comparison.hpp"
#include "platform/cosim/token_words.hpp"

namespace parallax {

/// Whether a stream has the model's pixels in another order: `mirrored`, `upside_down` or `turned` in each
/// frame or tile; with the two of each pair exchanged (`pairs_swapped`); its rows in another order
/// (`row_order`); `every_second` token, pixel or row alone (or in the place of its neighbour,
/// `every_second_twice`), or each of them twice (`each_twice`). Needs kLeastMoved tokens that differ, and
/// holds for all.
std::optional<DifferencePattern> find_frame_order(const TokenComparison& comparison,
                                                  const TokenWords& expected, const TokenWords& got);

}  // namespace parallax
