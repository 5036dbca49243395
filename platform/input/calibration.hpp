// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/matx.hpp>
#include <string>
#include <vector>

namespace parallax {

enum class LensModel {
  kPinhole,  ///< pinhole with radial-tangential distortion, 4, 5, 8, 12 or 14 coefficients in OpenCV's order
  kFisheye,  ///< equidistant, 4 coefficients
  kRectified,  ///< the images are rectified already
};

struct Lens {
  cv::Matx33d camera = cv::Matx33d::eye();  ///< px
  std::vector<double> distortion;
};

struct ImageSize {
  int width = 0;   ///< px; 0 = not known
  int height = 0;  ///< px; 0 = not known
};

/// A calibrated stereo pair in OpenCV's terms: x2 = R x1 + T, and the rectification of cv::stereoRectify.
struct Calibration {
  std::string source;  ///< file name(s), for messages
  LensModel model = LensModel::kPinhole;
  ImageSize size;
  Lens left;
  Lens right;
  cv::Matx33d R1 = cv::Matx33d::eye();
  cv::Matx33d R2 = cv::Matx33d::eye();
  cv::Matx34d P1;    ///< px; all zero for a rectified pair of unknown focal length
  cv::Matx34d P2;    ///< px; the fourth column in px * unit
  cv::Matx44d Q;     ///< disparity to depth; all zero when P1 is
  std::string unit;  ///< of T and so of the depth; empty when the file does not say

  /// Whether disparities can be turned into depths.
  bool metric() const { return P1(0, 0) > 0; }
  /// Distance of the cameras in `unit`.
  double baseline() const { return metric() ? -P2(0, 3) / P2(0, 0) : 0; }
};

/// Reads OpenCV FileStorage (YAML, XML or JSON): one file, or several that complete each other (the
/// intrinsics.yml and extrinsics.yml of OpenCV's stereo_calib sample). Entries, with the other names they may
/// have:
///   camera_model: pinhole_radtan (the default; pinhole, plumb_bob, rational_polynomial), fisheye_equidistant
///     (fisheye, equidistant) or rectified
///   image_width, image_height, or image_size: [w, h] (imageSize)
///   K1, K2 (M1, cameraMatrix1, ...), D1, D2 (distCoeffs1, ...), R (3x3 or rotation vector), T
///   R1, R2, P1, P2, optionally Q: all or none
/// Without R1..P2 they are computed by cv::stereoRectify or cv::fisheye::stereoRectify with
/// CALIB_ZERO_DISPARITY and alpha (balance) 0, that is, zoomed until no pixel lies outside the raw images;
/// with them R and T are not needed. Fisheye lenses so wide that OpenCV's principal point falls outside the
/// image get their own mean focal length and the image's centre instead. `size` stands in when the files do
/// not state the image size. Throws UserError naming file and entry.
Calibration read_calibration(const std::vector<std::string>& paths, const ImageSize& size = {});

/// Throws UserError unless the calibration is for images of this size.
void check_size(const Calibration& calibration, const ImageSize& images);

/// Q of two projection matrices, as cv::stereoRectify defines it.
cv::Matx44d disparity_to_depth(const cv::Matx34d& P1, const cv::Matx34d& P2);

}  // namespace parallax
