// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/input/calibration_request.hpp"
#include "platform/input/stated_calibration.hpp"
#include "platform/input/top_level.hpp"

namespace parallax {

bool is_orb_slam_calibration(const TopLevel& file);

/// The settings of ORB-SLAM3 (File.version 1.0): Camera.type PinHole (k1 k2 p1 p2, k3 if it is there),
/// KannalaBrandt8 (OpenCV's fisheye) or Rectified; Camera1, the left one, and Camera2; Camera.width, height.
/// x_1 = Stereo.T_c1_c2 x_2, metres; Rectified has Stereo.b instead, and Camera1 alone. Throws UserError
/// naming file and entry.
StatedCalibration read_orb_slam_calibration(const CalibrationRequest& request);

}  // namespace parallax
