// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/input/calibration_request.hpp"
#include "platform/input/stated_calibration.hpp"
#include "platform/input/top_level.hpp"

namespace parallax {

bool is_kitti_raw_calibration(const TopLevel& file);

/// calib_cam_to_cam.txt of KITTI's raw data, stereo 2015 and KITTI-360: S, K, D of raw images, R_rect and
/// P_rect of rectified ones, which have another size, S_rect. The size of the images at hand says which they
/// are; where it is not known, they are raw. P_rect(0,3) = -fx * (how far right of camera 0), metres. Without
/// R_rect and P_rect the images are raw, and the pair is placed by R and T: x_camera = R x_0 + T, of camera
/// 0. Throws UserError naming file and entry.
StatedCalibration read_kitti_raw_calibration(const CalibrationRequest& request);

}  // namespace parallax
