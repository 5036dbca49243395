// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/input/calibration_request.hpp"
#include "platform/input/stated_calibration.hpp"
#include "platform/input/top_level.hpp"

namespace parallax {

bool is_middlebury_calibration(const TopLevel& file);

/// calib.txt of Middlebury's stereo data (2014 and later) and ETH3D's two-view sets: cam0 and cam1, camera
/// matrices of rectified images, baseline in mm, doffs = cx1 - cx0, so that depth = baseline * f / (disparity
/// + doffs). No lens. Throws UserError naming file and entry.
StatedCalibration read_middlebury_calibration(const CalibrationRequest& request);

}  // namespace parallax
