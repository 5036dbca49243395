// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "platform/cosim/stage_effect.hpp"
#include "platform/cosim/token_comparison.hpp"
#include "platform/cosim/token_words.hpp"

namespace parallax {

/// Whether a stream that differs has the tokens that the model has in another stream that is alike:
/// `exchanged_streams` of an output, as left and right that are exchanged or an output that is there twice;
/// `input_unchanged` of the stage's input, as a filter that does nothing. Nothing where that stream has one
/// value everywhere, which others have too, or where `model` does not have it.
std::optional<DifferencePattern> find_other_stream(const TokenComparison& comparison, const TokenWords& got,
                                                   const ModelTokens& model);

}  // namespace parallax
