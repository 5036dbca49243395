// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "platform/cosim/token_comparison.hpp"
#include "platform/cosim/token_words.hpp"

namespace parallax {

/// The most telling pattern of each frame that differs, looked at alone, the frames counted by the model's
/// tokens; one for all frames, if it is the same. Nothing of one frame, or where no frame has one that
/// explains what came out of it.
std::vector<DifferencePattern> find_frame_patterns(const TokenComparison& comparison,
                                                   const TokenWords& expected, const TokenWords& got);

}  // namespace parallax
