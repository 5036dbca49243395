// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/matx.hpp>
#include <optional>
#include <string>
#include <vector>

namespace parallax {

enum class LensModel {
  kPinhole,  ///< pinhole with radial-tangential distortion, 4, 5, 8, 12 or 14 coefficients in OpenCV's order
  kFisheye,  ///< pinhole with equidistant distortion, 4 coefficients
  kRectified,  ///< the images are rectified already
};

struct Lens {
  cv::Matx33d camera = cv::Matx33d::eye();  ///< px
  std::vector<double> distortion;
};

/// The model of a distortion under one of the names that OpenCV, ROS and Kalibr have for it:
/// radial-tangential (plumb_bob, radtan, radial_tangential, rational_polynomial) or equidistant (fisheye,
/// kannala_brandt, ...). None for another name.
std::optional<LensModel> distortion_model(const std::string& name);

constexpr double kLeastFocal = 1;      ///< px: one that is counted in image widths is less
constexpr double kLargestFocal = 1e7;  ///< px: a lens of 1 m on pixels of 0.1 um

/// Whether a focal length is within these; NaN is not.
inline bool plausible_focal(double focal) { return focal >= kLeastFocal && focal <= kLargestFocal; }

/// Throws UserError, whose line begins with `where`, unless it is a camera matrix: finite, focal lengths of 1
/// to 1e7 px, no skew to speak of (1e-4 of them: OpenCV leaves it out), last row 0 0 1.
void check_camera(const cv::Matx33d& camera, const std::string& where);

/// Throws UserError unless the model has so many coefficients.
void check_distortion(const std::vector<double>& coefficients, LensModel model, const std::string& where);

/// How far R may be from a rotation: calibrations written with few digits pass, garbled ones do not.
constexpr double kRotationTolerance = 1e-2;

/// Throws UserError unless it is a rotation to kRotationTolerance.
void check_rotation(const cv::Matx33d& r, const std::string& where);

}  // namespace parallax
