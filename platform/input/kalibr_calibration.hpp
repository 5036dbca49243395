// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/input/calibration_request.hpp"
#include "platform/input/stated_calibration.hpp"
#include "platform/input/top_level.hpp"

namespace parallax {

bool is_kalibr_calibration(const TopLevel& file);

/// A camchain of Kalibr, cam0, cam1, ...: any two of its cameras. Its camera_model is the projection,
/// pinhole, its distortion_model radtan, equidistant or none. x_cn = T_cn_cnm1 x_cnm1, metres, as OpenCV's R
/// and T; where a camera lacks it, T_cam_imu of both stands in, or T_imu_cam,
/// which OpenVINS writes. The images are raw. Throws UserError naming
/// file and entry.
StatedCalibration read_kalibr_calibration(const CalibrationRequest& request);

}  // namespace parallax
