// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "modules/disparity_filter_stage.hpp"
#include "modules/gap_interpolation.hpp"

namespace parallax {

/// Gap interpolation, looking ahead l_max rows (paper, "Gap Interpolation").
using GapInterpolationStage = DisparityFilterStage<GapInterpolation, GapInterpolationConfig>;

}  // namespace parallax
