// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "platform/cosim/token_comparison.hpp"
#include "platform/cosim/token_words.hpp"

namespace parallax {

/// Whether one stream is the other, but for its end: `truncated`, `surplus`; none where tokens differ.
std::vector<DifferencePattern> find_end(const TokenComparison& comparison);

/// Whether it is the model's up to the first token that differs, and one value from there on, as of a circuit
/// that runs out of input (`constant_end`); needs kLeastMoved tokens that differ.
std::optional<DifferencePattern> find_constant_end(const TokenComparison& comparison, const TokenWords& got);

/// The first of the tokens at the end of a stream that are all the same.
std::uint64_t constant_from(const TokenWords& words);

/// "token 130 (frame 0, row 2, column 2)", in the stream of all frames.
std::string place_text(const TokenComparison& comparison, std::uint64_t token);

}  // namespace parallax
