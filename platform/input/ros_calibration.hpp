// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/input/calibration_request.hpp"
#include "platform/input/stated_calibration.hpp"
#include "platform/input/top_level.hpp"

namespace parallax {

bool is_ros_calibration(const TopLevel& file);

/// ROS camera_info, one file for each camera, left and right, in the form of camera_calibration
/// (image_width, camera_matrix, ...) or of the message as `rostopic echo` and `ros2 topic echo` print it
/// (width, K or k, ...). The images are raw. P(0,3) = -fx * baseline on the right, metres; x_rectified =
/// rectification_matrix x_camera, as OpenCV's R1 and R2. Throws UserError naming file and entry.
StatedCalibration read_ros_calibration(const CalibrationRequest& request);

}  // namespace parallax
