// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "modules/disparity_filter_stage.hpp"
#include "tests/example/fill_from_left.hpp"

namespace parallax {

/// Fills invalid pixels from the left: one disparity in, one out, nothing held back.
using FillFromLeftStage = DisparityFilterStage<FillFromLeft, FillFromLeftConfig>;

}  // namespace parallax
