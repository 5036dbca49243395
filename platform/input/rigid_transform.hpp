// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/matx.hpp>
#include <string>

#include "platform/input/stated_calibration.hpp"
#include "platform/input/yaml_entries.hpp"

namespace parallax {

/// A 4x4 entry that turns and moves. Throws UserError when it is another matrix.
cv::Matx44d rigid_transform(const YamlEntries& entries, const std::string& name);

/// Of a rotation and a translation, without the errors that inverting the digits of a file adds.
cv::Matx44d rigid_inverse(const cv::Matx44d& t);

/// From the left camera's axes to the right one's; `name` is where it stands, for messages.
StatedCalibration::Pose pose_of(const cv::Matx44d& left_to_right, const std::string& name);

}  // namespace parallax
