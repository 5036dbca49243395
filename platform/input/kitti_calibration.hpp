// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/input/calibration_request.hpp"
#include "platform/input/stated_calibration.hpp"
#include "platform/input/top_level.hpp"

namespace parallax {

bool is_kitti_calibration(const TopLevel& file);

/// KITTI's calib.txt (odometry, object, stereo 2012): P0 to P3, the projections of rectified images, all
/// relative to camera 0: P(0,3) = -fx * (how far right of it), metres. Cameras 0 and 1 are grey, 2 and 3
/// colour. It states no image size and no lens. Throws UserError naming file and entry.
StatedCalibration read_kitti_calibration(const CalibrationRequest& request);

}  // namespace parallax
