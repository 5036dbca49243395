// SPDX-License-Identifier: Apache-2.0
// A calibration in each format that is read, of cameras with images of 64x48.
#pragma once

#include <string>
#include <vector>

#include "platform/scene/scene.hpp"

namespace parallax::test {

/// Between the two files of a pair, in a seed that holds both.
inline constexpr const char* kNextFile = "\n=====\n";

inline std::string kalibr_camera(const std::string& name) {
  return name +
         ":\n  camera_model: pinhole\n  distortion_coeffs: [-0.2, 0.05, 1.0e-04, -.0003]\n"
         "  distortion_model: radtan\n  intrinsics: [46.5, 46.25, 33.0, 23.5]\n  resolution: [64, 48]\n";
}

inline std::string kitti_row(const std::string& name, const std::string& x) {
  return name + ": 5.0e+01 0 3.2e+01 " + x + " 0 5.0e+01 2.4e+01 0 0 0 1 0\n";
}

inline std::string kitti_raw_camera(const std::string& number, const std::string& x) {
  return "S_" + number + ": 6.4e+01 4.8e+01\nK_" + number +
         ": 5.1e+01 0 3.2e+01 0 5.2e+01 2.4e+01 0 0 1\nD_" + number +
         ": -3.7e-01 2.0e-01 1.0e-03 5.0e-04 -7.2e-02\nR_" + number + ": 1 0 0 0 1 0 0 0 1\nS_rect_" +
         number + ": 6.0e+01 4.0e+01\nR_rect_" + number + ": 1 0 0 0 1 0 0 0 1\n" +
         kitti_row("P_rect_" + number, x);
}

inline std::vector<std::string> calibration_seeds() {
  SceneConfig config;
  config.width = 64;
  config.height = 48;
  return {
      to_yaml(Scene(config).calibration()),
      kalibr_camera("cam0") + kalibr_camera("cam1") +
          "  T_cn_cnm1:\n  - [1, 0, 0, -0.1]\n  - [0, 1, 0, 0]\n  - [0, 0, 1, 0]\n  - [0, 0, 0, 1]\n",
      kitti_row("P0", "0") + kitti_row("P1", "-2.5e+01"),
      kitti_raw_camera("00", "0") + kitti_raw_camera("01", "-2.5e+01"),
      "cam0=[100 0 31.5; 0 100 25.25; 0 0 1]\ncam1=[100 0 34.75; 0 100 25.25; 0 0 1]\ndoffs=3.25\n"
      "baseline=200\nwidth=64\nheight=48\nndisp=70\n",
      "S_00: 64 48\nK_00: 50 0 32 0 50 24 0 0 1\nD_00: -0.1 0 0 0 0\nR_00: 1 0 0 0 1 0 0 0 1\nT_00: 0 0 0\n"
      "S_01: 64 48\nK_01: 50 0 32 0 50 24 0 0 1\nD_01: -0.1 0 0 0 0\nR_01: 1 0 0 0 1 0 0 0 1\nT_01: -0.5 0 "
      "0\n",
      "%YAML:1.0\nCamera.type: \"Rectified\"\nCamera1.fx: 50\nCamera1.fy: 50\nCamera1.cx: 32\nCamera1.cy: "
      "24\n"
      "Camera.width: 64\nCamera.height: 48\nStereo.b: 0.125\n"};
}

inline std::string ros_camera(const std::string& x) {
  return "image_width: 64\nimage_height: 48\ncamera_name: a\ncamera_matrix:\n  rows: 3\n  cols: 3\n  data: "
         "[50., 0., 32., 0., 50., 24., 0., 0., 1.]\ndistortion_model: plumb_bob\ndistortion_coefficients:\n"
         "  rows: 1\n  cols: 5\n  data: [-0.2, 0.05, 0.001, -0.002, 0.]\nrectification_matrix:\n  rows: 3\n"
         "  cols: 3\n  data: [1., 0., 0., 0., 1., 0., 0., 0., 1.]\nprojection_matrix:\n  rows: 3\n  cols: 4\n"
         "  data: [45., 0., 32., " +
         x + ", 0., 45., 24., 0., 0., 0., 1., 0.]\n";
}

inline std::string euroc_camera(const std::string& x) {
  return "sensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: [1.0, 0.0, 0.0, " + x +
         ",\n         0.0, 1.0, 0.0, 0.2,\n         0.0, 0.0, 1.0, 0.3,\n         0.0, 0.0, 0.0, 1.0]\n"
         "resolution: [64, 48]\ncamera_model: pinhole\nintrinsics: [45.5, 45.0, 33.0, 23.5]\n"
         "distortion_model: radial-tangential\n"
         "distortion_coefficients: [-0.28, 0.07, 0.0002, 1.76e-05]\n";
}

inline std::vector<std::string> calibration_pair_seeds() {
  return {ros_camera("0.") + kNextFile + ros_camera("-4.5"),
          euroc_camera("0.1") + kNextFile + euroc_camera("0.2")};
}

}  // namespace parallax::test
