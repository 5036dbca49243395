// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/input/stated_calibration.hpp"

namespace parallax {

/// Where a pair is turned to, and what it then projects to.
struct RectifiedPair {
  cv::Matx33d R1;
  cv::Matx33d R2;
  cv::Matx34d P1;
  cv::Matx34d P2;
};

/// As complete() says. The lenses are checked, the pose is given. Throws UserError when the cameras are above
/// each other, or OpenCV cannot.
RectifiedPair rectify_pair(const StatedCalibration& stated);

}  // namespace parallax
