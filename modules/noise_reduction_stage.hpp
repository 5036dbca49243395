// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "modules/disparity_filter_stage.hpp"
#include "modules/noise_reduction.hpp"

namespace parallax {

/// Noise reduction, with half a window of look-ahead (paper, "Noise Reduction").
using NoiseReductionStage = DisparityFilterStage<NoiseReduction, NoiseReductionConfig>;

}  // namespace parallax
