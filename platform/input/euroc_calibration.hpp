// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/input/calibration_request.hpp"
#include "platform/input/stated_calibration.hpp"
#include "platform/input/top_level.hpp"

namespace parallax {

bool is_euroc_calibration(const TopLevel& file);

/// The sensor.yaml of the EuRoC data set (ASL format), one file for each camera, left and right: raw images,
/// pinhole, radial-tangential or equidistant. x_body = T_BS x_camera, metres. Throws UserError naming file
/// and entry.
StatedCalibration read_euroc_calibration(const CalibrationRequest& request);

}  // namespace parallax
