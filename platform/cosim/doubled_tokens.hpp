// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "platform/cosim/token_comparison.hpp"
#include "platform/cosim/token_words.hpp"

namespace parallax {

/// Whether a stream is the model's with some tokens twice, two or more, as far as it goes (`tokens_doubled`):
/// what they push out at its end may be missing, as where a frame is counted by its tokens.
std::optional<DifferencePattern> find_doubled_tokens(const TokenComparison& comparison,
                                                     const TokenWords& expected, const TokenWords& got);

}  // namespace parallax
