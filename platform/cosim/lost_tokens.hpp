// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "platform/cosim/token_comparison.hpp"
#include "platform/cosim/token_words.hpp"

namespace parallax {

/// Whether a stream is the model's with some tokens left out or too many, at one place (tokens, or whole
/// rows), at one column of each row, or at several places between which the tokens agree. `differing`: the
/// first tokens that differ, kLeastExplained or more of them in all.
std::vector<DifferencePattern> find_lost_tokens(const TokenComparison& comparison, const TokenWords& expected,
                                                const TokenWords& got,
                                                const std::vector<std::uint64_t>& differing);

}  // namespace parallax
