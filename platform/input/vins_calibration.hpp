// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/input/calibration_request.hpp"
#include "platform/input/stated_calibration.hpp"
#include "platform/input/top_level.hpp"

namespace parallax {

bool is_vins_calibration(const TopLevel& file);

/// Files of camodocal and of the estimators that use its camera models (VINS-Fusion and others): one for each
/// camera, left and right, with model_type PINHOLE, PINHOLE_FULL or KANNALA_BRANDT, and the estimator's, with
/// body_T_cam0 and body_T_cam1: x_body = body_T_cam x_camera, metres. The images are raw.
///
/// Kannala-Brandt: r = theta + k2 theta^3 + k3 theta^5 + k4 theta^7 + k5 theta^9, which is OpenCV's fisheye
/// with k1 to k4; mu, mv are the focal lengths. PINHOLE_FULL is the rational model.
///
/// Throws UserError naming file and entry.
StatedCalibration read_vins_calibration(const CalibrationRequest& request);

/// The files of the cameras that an estimator's file names (cam0_calib, cam1_calib), beside it where their
/// paths are relative; none when it is not such a file.
std::vector<std::string> camera_files_of_estimator(const CalibrationRequest::File& file);

}  // namespace parallax
