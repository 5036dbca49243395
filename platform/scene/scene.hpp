// SPDX-License-Identifier: Apache-2.0
// The built-in scene: a stereo pair, its calibration and its exact ground truth, without any file.
#pragma once

#include <opencv2/core/mat.hpp>

#include "platform/scene/scene_calibration.hpp"
#include "platform/scene/scene_config.hpp"
#include "platform/scene/scene_view.hpp"
#include "platform/scene/stereo_images.hpp"

namespace parallax {

/// In the rectified left image, by casting the ray of each pixel's centre.
struct SceneTruth {
  /// CV_16UC1, round(256 * disparity), 0 = unknown: the raw left image does not show this pixel.
  cv::Mat disparity;
  /// CV_8UC1: 255 visible in both raw images, and the match lies inside the rectified right image; 128
  /// disparity known, but occluded or outside the right image; 0 unknown.
  cv::Mat mask;
};

/// A room with a back wall, a floor and a slanting side wall, in it a weakly textured panel, a slanted board
/// with stripes, a disc, a pole and a near box. The same configuration and frame give the same bytes on every
/// machine.
class Scene {
 public:
  explicit Scene(const SceneConfig& config);

  const SceneCalibration& calibration() const { return calibration_; }
  /// The raw images: distorted and not rectified, unless the distortion is off. `frame` can be any number:
  /// the motion repeats every 128 frames, the noise does not.
  StereoImages render(int frame) const;
  SceneTruth truth(int frame) const;

 private:
  SceneConfig config_;
  SceneCalibration calibration_;
  SceneTextures textures_;
  SceneView left_;
  SceneView right_;
};

}  // namespace parallax
