// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/matx.hpp>
#include <optional>
#include <string>

#include "platform/input/calibration.hpp"

namespace parallax {

/// What a file says of a stereo pair, in OpenCV's terms and not yet checked. `name` is where an entry stands,
/// with the file, for messages.
struct StatedCalibration {
  struct StatedLens {
    std::string camera_name;
    std::string distortion_name;
    Lens lens;
  };
  struct Pose {  ///< x_right = R x_left + T
    std::string rotation_name;
    std::string translation_name;
    cv::Matx33d R;
    cv::Vec3d T;
  };
  struct Rotations {
    std::string left_name;
    std::string right_name;
    cv::Matx33d R1;
    cv::Matx33d R2;
  };
  struct Projections {
    std::string name;
    cv::Matx34d P1;
    cv::Matx34d P2;
  };
  struct Reprojection {
    std::string name;
    cv::Matx44d Q;
  };

  std::string source;
  LensModel model = LensModel::kPinhole;
  ImageSize size;
  std::optional<StatedLens> left;
  std::optional<StatedLens> right;
  std::optional<Pose> pose;
  std::optional<Rotations> rotations;
  std::optional<Projections> projections;
  std::optional<Reprojection> reprojection;
  std::string unit;
};

/// Checks it all, each part by itself and against the others, and adds what follows from it. A pair with
/// lenses that has no projections gets those of cv::stereoRectify or cv::fisheye::stereoRectify with
/// CALIB_ZERO_DISPARITY and alpha (balance) 0, that is, zoomed until no pixel lies outside the raw images;
/// fisheye lenses so wide that OpenCV's principal point falls outside the image get their own mean focal
/// length and the image's centre instead. A rectified pair has the geometry of its projections, of Q, or of
/// cameras and T, or none. Throws UserError.
Calibration complete(const StatedCalibration& stated);

/// The size of an image, from numbers that a file states. Throws UserError, whose line begins with `where`,
/// unless they are whole and from 1 to 65535.
ImageSize image_size(double width, double height, const std::string& where);

}  // namespace parallax
