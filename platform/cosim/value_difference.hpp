// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "platform/cosim/token_comparison.hpp"
#include "platform/cosim/token_words.hpp"
#include "platform/cosim/vector_manifest.hpp"

namespace parallax {

/// Of disparities, whether no value is another than the model's but in which are valid: `invalid_as`, where
/// another number stands for none and does so for all that are invalid; `only_validity`. Both where that
/// number is another and more are invalid, or less. Nothing if some are unknown.
std::vector<DifferencePattern> find_validity(const VectorStream& stream, const TokenWords& expected,
                                             const TokenWords& got);

/// What numbers that differ have in common, wherever they lie: that they are off by 1, and which way, or that
/// the lowest bits are right. Nothing if some are unknown.
std::optional<DifferencePattern> find_value_difference(const VectorStream& stream, const TokenWords& expected,
                                                       const TokenWords& got);

/// Of codes, whether bits are set where the model has none and never the other way (`only_set_bits`), or the
/// reverse (`only_cleared_bits`): a comparison that takes equal values for less, or does not. Needs so many
/// that this is no chance, and not one value wherever a token differs, as if masked. Nothing of other tokens,
/// or if some bits are unknown.
std::optional<DifferencePattern> find_one_way_bits(const VectorStream& stream, const TokenWords& expected,
                                                   const TokenWords& got);

}  // namespace parallax
