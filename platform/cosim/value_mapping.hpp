// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "platform/cosim/token_comparison.hpp"
#include "platform/cosim/token_words.hpp"

namespace parallax {

/// What each value is of the model's at the same place: its bits, bytes or fields in another order, inverted,
/// cut off, moved by a constant, or a comparison the other way round. Holds for all; `differing`: the first
/// tokens that differ.
std::optional<DifferencePattern> find_value_mapping(const TokenComparison& comparison,
                                                    const TokenWords& expected, const TokenWords& got,
                                                    const std::vector<std::uint64_t>& differing);

}  // namespace parallax
