// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "modules/matching.hpp"
#include "modules/matching_stage.hpp"
#include "platform/machine/token_port.hpp"

namespace parallax {

/// What is taken inside the matcher, as tokens of the shape of its output, but for the width and the order of
/// pixels: pixel_costs, and path_w, ... for each path that is configured. `taps`: what `stage` was opened
/// with or will be, once one of them is tapped. They have no dates: each token's is 0. One tap each at a
/// time. All must outlive the simulation.
std::vector<TokenPort> matching_tap_ports(const MatchingConfig& config, int code_bits,
                                          const TokenShape& costs, MatchingStage& stage, MatchingTaps& taps);

}  // namespace parallax
