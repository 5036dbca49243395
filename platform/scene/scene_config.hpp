// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace parallax {

/// What the built-in scene shows and how its two cameras see it. Every field is our own choice of default;
/// the limits of the disparity range are the device's.
struct SceneConfig {
  int width = 640;        ///< px, 1..65536
  int height = 480;       ///< px, 1..65536
  int disparities = 128;  ///< px, 1..256: range the scene's depths fill; a width below 3 times it narrows it
  int disparity_offset = 0;  ///< px, 0..255: smallest disparity, offset + disparities <= 256
  std::uint64_t seed = 1;    ///< any: textures, placement and noise
  bool distortion = true;    ///< lens distortion and misaligned cameras; false: the raw images are rectified
  double read_noise = 1.0;   ///< grey levels, 0..50: standard deviation of the sensor's constant noise
  double shot_noise = 0.01;  ///< grey levels, 0..1: variance of the shot noise per grey level of signal
  double vignetting = 0.1;   ///< share of the light lost in the image corner, 0..0.9
  double motion = 1.0;       ///< 0..2: amplitude of camera and object motion, 0 = every frame the same scene

  void validate() const;
};

}  // namespace parallax
