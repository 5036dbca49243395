// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

namespace parallax {

/// What two cameras saw at one time: CV_8UC1, of one size.
struct StereoImages {
  cv::Mat left;
  cv::Mat right;
};

}  // namespace parallax
