// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "platform/results/ground_truth.hpp"

namespace parallax {

/// The scale with which the truth would agree with what was found, when with its own hardly anything does:
/// fewer than a quarter of the pixels that have both are within 1 px or 5 %, and at least half, and 100, with
/// the other one. A common scale (1, 2, 4, 8, 16, 256, ...) where one is within 6 %. Nothing otherwise.
std::optional<double> better_truth_scale(const std::vector<Disparity>& found, const GroundTruth& truth);

/// One line for the user, also when the truth would agree if it were depth; empty when there is nothing to
/// say.
std::string truth_scale_notice(const std::vector<Disparity>& found, const GroundTruth& truth);

}  // namespace parallax
