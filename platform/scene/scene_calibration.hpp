// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/matx.hpp>
#include <string>

#include "platform/scene/scene_config.hpp"

namespace parallax {

/// A pinhole camera with five radial-tangential coefficients (k1 k2 p1 p2 k3), turned against the rectified
/// frame.
struct SceneLens {
  cv::Matx33d camera_matrix = cv::Matx33d::eye();        ///< K1 or K2, px
  cv::Vec<double, 5> distortion{0, 0, 0, 0, 0};          ///< D1 or D2
  cv::Matx33d rectifying_rotation = cv::Matx33d::eye();  ///< R1 or R2: camera coordinates to rectified ones

  /// From a ray of the rectified camera (z = 1) to the pixel of the raw image.
  cv::Vec2d project(const cv::Vec2d& rectified_ray) const;
  /// The inverse, by fixed-point iteration to below 1e-12.
  cv::Vec2d unproject(const cv::Vec2d& raw_pixel) const;
};

/// Both cameras of the scene, in the conventions of cv::stereoRectify, consistent to rounding by
/// construction: x2 = R x1 + T with R = R2' R1 and T = -R2' (baseline, 0, 0).
struct SceneCalibration {
  int width = 0;
  int height = 0;
  int disparities = 0;
  bool rectified = false;  ///< the raw images need no rectification
  SceneLens left;
  SceneLens right;
  cv::Matx33d r = cv::Matx33d::eye();
  cv::Vec3d t{0, 0, 0};  ///< m
  cv::Matx34d p1;
  cv::Matx34d p2;
  cv::Matx44d q;

  /// Largest absolute x or y displacement of the rectification map, px, over a grid that includes the
  /// corners.
  double largest_offset() const;
};

/// Real work for the rectification at every size, within what the device's 79x79 window can do: at most 34 of
/// its 39 px. Lens distortion and misalignment are weakened for images that are so large that they would
/// exceed it.
SceneCalibration scene_calibration(const SceneConfig& config);

/// OpenCV FileStorage text (YAML): camera_model, image_width, image_height, num_disparities, T_unit,
/// K1 D1 K2 D2 R T R1 R2 P1 P2 Q.
std::string to_yaml(const SceneCalibration& calibration);

}  // namespace parallax
