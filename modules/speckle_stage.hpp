// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "modules/disparity_filter_stage.hpp"
#include "modules/speckle.hpp"

namespace parallax {

/// Speckle filter, with half a window of look-ahead for each pass (paper, "Speckle Filtering").
using SpeckleStage = DisparityFilterStage<Speckle, SpeckleConfig>;

}  // namespace parallax
