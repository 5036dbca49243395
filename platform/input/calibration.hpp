// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/matx.hpp>
#include <optional>
#include <string>

#include "platform/input/lens.hpp"
#include "platform/input/stereo_geometry.hpp"

namespace parallax {

struct ImageSize {
  int width = 0;   ///< px; 0 = not known
  int height = 0;  ///< px; 0 = not known
};

/// A calibrated stereo pair in OpenCV's terms, whatever it was read from.
struct Calibration {
  std::string source;  ///< file name(s), for messages
  LensModel model = LensModel::kPinhole;
  ImageSize size;
  Lens left;                            ///< not used when the images are rectified
  Lens right;                           ///< likewise
  cv::Matx33d R1 = cv::Matx33d::eye();  ///< from the left camera's axes to those of the rectified pair
  cv::Matx33d R2 = cv::Matx33d::eye();
  cv::Matx34d P1;  ///< projections of the rectified pair, px; the fourth column in px * unit
  cv::Matx34d P2;
  std::optional<StereoGeometry> geometry;  ///< that of P1 and P2; none for a rectified pair without scale
  std::string choice;  ///< which cameras of several were taken without being asked for; mostly empty
  std::string unit;    ///< of the baseline and so of the depth; empty when the file does not say
};

/// Throws UserError unless the calibration is for images of this size. Where other cameras of the file might
/// fit, it says so.
void check_size(const Calibration& calibration, const ImageSize& images);

}  // namespace parallax
