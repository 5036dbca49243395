// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "platform/input/stated_calibration.hpp"
#include "platform/input/yaml_entries.hpp"

namespace parallax {

/// Model, size and lenses of two cameras as Kalibr and EuRoC write them: camera_model, the projection, must
/// be pinhole; distortion_model is radial-tangential, equidistant or none, its coefficients in the entry
/// `coefficients`; intrinsics [fx, fy, cx, cy]; resolution [w, h]. Throws UserError, also when the two are of
/// another size or model.
StatedCalibration pinhole_pair(const YamlEntries& left, const YamlEntries& right,
                               const std::string& coefficients);

}  // namespace parallax
