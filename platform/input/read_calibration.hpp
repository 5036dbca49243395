// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "platform/input/calibration.hpp"
#include "platform/input/calibration_request.hpp"

namespace parallax {

/// Reads a calibration of any known format, told by its content: OpenCV FileStorage (one file or several that
/// complete each other), ROS camera_info (two files, left and right), a Kalibr camchain, KITTI's calib.txt or
/// calib_cam_to_cam.txt, Middlebury's calib.txt, VINS-Fusion's and ORB-SLAM3's; each may be gzip. `images` is
/// the size of those at hand, for files that state none. `cameras` is for formats with more than two: if not
/// given, 0 and 1. Throws UserError.
Calibration read_calibration(const std::vector<std::string>& paths, const ImageSize& images = {},
                             const std::optional<CameraPair>& cameras = std::nullopt);

/// "2,3", of `option`; none if it is empty. Throws UserError.
std::optional<CameraPair> camera_pair(const std::string& option, const std::string& text);

}  // namespace parallax
