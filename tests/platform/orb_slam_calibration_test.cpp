// SPDX-License-Identifier: Apache-2.0
#include "platform/input/orb_slam_calibration.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "platform/input/read_calibration.hpp"
#include "tests/platform/test_calibrations.hpp"

namespace parallax {
namespace orb_slam_calibration_test {

using test::message;

std::string camera(const std::string& name, const std::string& fx, const std::string& last) {
  std::string text;
  for (const std::string& entry : {"fx: " + fx, std::string("fy: 451.0"), std::string("cx: 330.5"),
                                   std::string("cy: 235"), std::string("k1: -0.28"), std::string("k2: 0.07")})
    text += name + "." + entry + "\n";
  return text + last;
}

std::string settings(const std::string& type, const std::string& cameras, const std::string& rig) {
  return "%YAML:1.0\n\n#----\n# Parameters\n#----\nFile.version: \"1.0\"\n\nCamera.type: \"" + type +
         "\"\n\n" + cameras +
         "\nCamera.width: 640\nCamera.height: 480\n# Camera frames per second\nCamera.fps: 20\n\n" + rig;
}

// The right camera is at (x, 0, 0) from the left one, with parallel axes: x_1 = x_2 + (x, 0, 0).
std::string beside(const std::string& x) {
  return "Stereo.ThDepth: 60.0\nStereo.T_c1_c2: !!opencv-matrix\n  rows: 4\n  cols: 4\n  dt: f\n  data: "
         "[1.0, 0, 0, " +
         x + ",\n         0, 1.0, 0, 0,\n         0, 0, 1.0, 0,\n         0, 0, 0, 1.000000000000000]\n";
}

class OrbSlamCalibration : public test::FolderTest {
 protected:
  Calibration read(const std::string& text) const { return read_calibration({write("slam.yaml", text)}); }
  std::string line(const std::string& text) const {
    const std::string whole = message([&] { read(text); });
    const std::string prefix = path("slam.yaml") + ": ";
    EXPECT_EQ(whole.find(prefix), 0U) << whole;
    return whole.substr(std::min(prefix.size(), whole.size()));
  }
};

std::string tangential(char number) {
  std::string text;
  for (const std::string& entry : {std::string("p1: 0.0002\n"), std::string("p2: 1.5e-05\n")})
    text += std::string("Camera") + number + "." + entry;
  return text;
}

TEST_F(OrbSlamCalibration, PinholeCameras) {
  const std::string cameras =
      camera("Camera1", "450.5", tangential('1')) + camera("Camera2", "470.5", tangential('2'));
  const Calibration c = read(settings("PinHole", cameras, beside("0.11")));
  EXPECT_EQ(c.model, LensModel::kPinhole);
  EXPECT_EQ(c.unit, "m");
  EXPECT_EQ(c.size.width, 640);
  EXPECT_EQ(c.left.camera, cv::Matx33d(450.5, 0, 330.5, 0, 451, 235, 0, 0, 1));
  EXPECT_EQ(c.right.camera(0, 0), 470.5);
  EXPECT_EQ(c.left.distortion, (std::vector<double>{-0.28, 0.07, 0.0002, 1.5e-05}));
  EXPECT_NEAR(c.geometry->baseline, 0.11, 1e-6);
  EXPECT_EQ(line(settings("PinHole", cameras, beside("-0.11"))),
            "the rectification of R and T: the right camera lies 0.11 to the left of the left one; are the "
            "images exchanged?");
  EXPECT_EQ(line(settings("PinHole", cameras, "")), "Stereo.T_c1_c2 is missing");
  EXPECT_EQ(line(settings("PinHole", camera("Camera1", "450.5", tangential('1')), beside("0.1"))),
            "Camera2.fx is missing");
  EXPECT_EQ(line(settings("Pinhole", cameras, beside("0.11"))),
            "Camera.type: \"Pinhole\" is not PinHole, KannalaBrandt8 or Rectified");
}

TEST_F(OrbSlamCalibration, FisheyeCameras) {
  const std::string cameras = camera("Camera1", "450.5", "Camera1.k3: -0.03\nCamera1.k4: 0.004\n") +
                              camera("Camera2", "450.5", "Camera2.k3: -0.03\nCamera2.k4: 0.004\n");
  const Calibration c = read(settings("KannalaBrandt8", cameras, beside("0.1")));
  EXPECT_EQ(c.model, LensModel::kFisheye);
  EXPECT_EQ(c.right.distortion, (std::vector<double>{-0.28, 0.07, -0.03, 0.004}));
  EXPECT_NEAR(c.geometry->baseline, 0.1, 1e-6);
}

TEST_F(OrbSlamCalibration, RectifiedImages) {
  const std::string cameras = "Camera1.fx: 500\nCamera1.fy: 500\nCamera1.cx: 320\nCamera1.cy: 240\n";
  const Calibration c = read(settings("Rectified", cameras, "Stereo.b: 0.125\n"));
  EXPECT_EQ(c.model, LensModel::kRectified);
  EXPECT_DOUBLE_EQ(c.geometry->baseline, 0.125);
  EXPECT_DOUBLE_EQ(c.geometry->focal_x, 500);
  EXPECT_DOUBLE_EQ(c.geometry->doffs(), 0);
  EXPECT_EQ(line(settings("Rectified", cameras, "")), "Stereo.b is missing");
}

}  // namespace orb_slam_calibration_test
}  // namespace parallax
