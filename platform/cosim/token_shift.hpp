// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "platform/cosim/token_comparison.hpp"
#include "platform/cosim/token_words.hpp"

namespace parallax {

/// So many tokens a rule must explain: one alone follows any.
inline constexpr std::size_t kLeastExplained = 2;

/// Whether one stream is the other, but for its end: `truncated`, `surplus`; none where tokens differ.
std::vector<DifferencePattern> find_end(const TokenComparison& comparison);

/// Whether a stream has the model's tokens in other places: some lost, or too many, or all of them late or
/// early, by some tokens, columns or rows. `differing`: the first tokens that differ, kLeastExplained or more
/// of them in all.
std::vector<DifferencePattern> find_shift(const TokenComparison& comparison, const TokenWords& expected,
                                          const TokenWords& got, const std::vector<std::uint64_t>& differing);

}  // namespace parallax
