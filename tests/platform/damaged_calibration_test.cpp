// SPDX-License-Identifier: Apache-2.0
// Every number of a file of every format, replaced by something else, and every file cut anywhere: what comes
// out is a calibration that makes sense, or one line that names the file.
#include <gtest/gtest.h>

#include <cmath>
#include <exception>
#include <functional>

#include "platform/input/read_calibration.hpp"
#include "tests/platform/test_calibrations.hpp"

namespace parallax {
namespace damaged_calibration_test {

std::string ros(const std::string& tx) {
  return "image_width: 64\nimage_height: 48\ncamera_matrix:\n  rows: 3\n  cols: 3\n  data: [50., 0., 32., "
         "0., 50., 24., "
         "0., 0., 1.]\ndistortion_model: plumb_bob\ndistortion_coefficients:\n  rows: 1\n  cols: 5\n  data: "
         "[-0.1, 0.01, "
         "0., 0., 0.]\nrectification_matrix:\n  rows: 3\n  cols: 3\n  data: [1., 0., 0., 0., 1., 0., 0., 0., "
         "1.]\n"
         "projection_matrix:\n  rows: 3\n  cols: 4\n  data: [45., 0., 32., " +
         tx + ", 0., 45., 24., 0., 0., 0., 1., 0.]\n";
}

std::string kalibr() {
  const std::string camera =
      "  camera_model: pinhole\n  intrinsics: [50.0, 50.0, 32.0, 24.0]\n  distortion_model: equidistant\n"
      "  distortion_coeffs: [0.01, 0.02, -0.01, 0.002]\n  resolution: [64, 48]\n";
  return "cam0:\n" + camera + "cam1:\n" + camera +
         "  T_cn_cnm1:\n  - [1.0, 0.0, 0.0, -0.1]\n  - [0.0, 1.0, 0.0, 0.0]\n  - [0.0, 0.0, 1.0, 0.0]\n"
         "  - [0.0, 0.0, 0.0, 1.0]\n";
}

constexpr const char* kKitti = "P0: 50 0 32 0 0 50 24 0 0 0 1 0\nP1: 50 0 32 -25 0 50 24 0 0 0 1 0\n";
constexpr const char* kKittiRaw =
    "S_00: 64 48\nK_00: 50 0 32 0 50 24 0 0 1\nD_00: -0.1 0 0 0 0\nR_rect_00: 1 0 0 0 1 0 0 0 1\nP_rect_00: "
    "45 0 32 0 0 45 24 "
    "0 0 0 1 0\nS_01: 64 48\nK_01: 50 0 32 0 50 24 0 0 1\nD_01: -0.1 0 0 0 0\nR_rect_01: 1 0 0 0 1 0 0 0 "
    "1\nP_rect_01: 45 0 32 "
    "-25 0 45 24 0 0 0 1 0\n";
constexpr const char* kMiddlebury =
    "cam0=[50 0 32; 0 50 24; 0 0 1]\ncam1=[50 0 33; 0 50 24; 0 0 "
    "1]\ndoffs=1\nbaseline=100\nwidth=64\nheight=48\n";

constexpr const char* kKittiUnrectified =
    "S_00: 64 48\nK_00: 50 0 32 0 50 24 0 0 1\nD_00: -0.1 0 0 0 0\nR_00: 1 0 0 0 1 0 0 0 1\nT_00: 0 0 0\n"
    "S_01: 64 48\nK_01: 50 0 32 0 50 24 0 0 1\nD_01: -0.1 0 0 0 0\nR_01: 1 0 0 0 1 0 0 0 1\nT_01: -0.5 0 0\n";
constexpr const char* kOrbSlam =
    "%YAML:1.0\nCamera.type: \"PinHole\"\nCamera1.fx: 50.5\nCamera1.fy: 50.25\nCamera1.cx: 32\nCamera1.cy: "
    "24\nCamera1.k1: -0.1\nCamera1.k2: 0.01\nCamera1.p1: 0\nCamera1.p2: 0\nCamera2.fx: 50\nCamera2.fy: 50\n"
    "Camera2.cx: 32\nCamera2.cy: 24\nCamera2.k1: -0.1\nCamera2.k2: 0.01\nCamera2.p1: 0\nCamera2.p2: 0\n"
    "Camera.width: 64\nCamera.height: 48\nStereo.T_c1_c2: !!opencv-matrix\n  rows: 4\n  cols: 4\n  dt: f\n"
    "  data: [1.0, 0, 0, 0.11,\n     0, 1.0, 0, 0,\n     0, 0, 1.0, 0,\n     0, 0, 0, 1.0]\n";
constexpr const char* kVinsRig =
    "%YAML:1.0\ncam0_calib: \"camera.yaml\"\ncam1_calib: \"camera.yaml\"\nbody_T_cam0: !!opencv-matrix\n"
    "   rows: 4\n   cols: 4\n   dt: d\n   data: [1, 0, 0, 0,\n     0, 1, 0, 0,\n     0, 0, 1, 0,\n     0, 0, "
    "0, 1]\n"
    "body_T_cam1: !!opencv-matrix\n   rows: 4\n   cols: 4\n   dt: d\n   data: [1, 0, 0, 0.12,\n     0, 1, 0, "
    "0,\n"
    "     0, 0, 1, 0,\n     0, 0, 0, 1]\n";
constexpr const char* kVinsCamera =
    "%YAML:1.0\n---\nmodel_type: KANNALA_BRANDT\nimage_width: 64\nimage_height: 48\nprojection_parameters:\n"
    "   k2: -0.01\n   k3: 0.02\n   k4: -0.03\n   k5: 0.004\n   mu: 50.5\n   mv: 50.25\n   u0: 32\n   v0: "
    "24\n";

class DamagedCalibration : public test::FolderTest {
 protected:
  // Reads it and says what is wrong with what came out, if anything is.
  std::string fault_of(const std::string& text) const {
    std::vector<std::string> files{write("damaged", text)};
    if (!other_.empty()) files.push_back(write("other", other_));
    try {
      const Calibration c = read_calibration(files, {64, 48});
      if (!c.geometry) return "";
      const StereoGeometry& g = *c.geometry;
      const bool sense = g.baseline > 0 && std::isfinite(g.baseline) && g.focal_x >= 1 && g.focal_y >= 1 &&
                         std::isfinite(g.cx_left + g.cx_right + g.cy + g.focal_x + g.focal_y);
      return sense ? "" : "a geometry without sense";
    } catch (const UserError& error) {
      const std::string line = error.what();
      if (line.rfind(path(""), 0) != 0) return "the file is not named: " + line;
      return line.find('\n') == std::string::npos ? "" : "more than a line: " + line;
    } catch (const std::exception& error) {
      return std::string("another exception: ") + error.what();
    }
  }

  void damage(const std::string& text, const std::string& other = "") {
    other_ = other;
    ASSERT_EQ(fault_of(text), "");
    EXPECT_EQ(test::message([&] { fault_or_throw(text); }), "") << "undamaged, it is read";
    for (std::size_t begin = 0; begin < text.size();) {
      begin = text.find_first_of("0123456789-.", begin);
      if (begin == std::string::npos) break;
      const std::size_t end = std::min(text.find_first_not_of("0123456789-.e+", begin), text.size());
      for (const char* instead :
           {"nan", "0", "-1", "1e308", "-1e308", "1e-308", "x", "", "1 2", "[", "{", "\"", "\t", "!!"}) {
        const std::string changed = text.substr(0, begin) + instead + text.substr(end);
        EXPECT_EQ(fault_of(changed), "")
            << text.substr(begin, end - begin) << " -> " << instead << " at " << begin;
      }
      begin = end;
    }
    for (std::size_t length = 0; length < text.size(); length += 17) {
      EXPECT_EQ(fault_of(text.substr(0, length)), "") << "cut at " << length;
    }
  }

 private:
  void fault_or_throw(const std::string& text) const {
    std::vector<std::string> files{write("damaged", text)};
    if (!other_.empty()) files.push_back(write("other", other_));
    read_calibration(files, {64, 48});
  }

  std::string other_;
};

TEST_F(DamagedCalibration, OfRos) { damage(ros("0."), ros("-4.5")); }
TEST_F(DamagedCalibration, OfKalibr) { damage(kalibr()); }
TEST_F(DamagedCalibration, OfKitti) { damage(kKitti); }
TEST_F(DamagedCalibration, OfKittiRaw) { damage(kKittiRaw); }
TEST_F(DamagedCalibration, OfKittiUnrectified) { damage(kKittiUnrectified); }
TEST_F(DamagedCalibration, OfOrbSlam) { damage(kOrbSlam); }
TEST_F(DamagedCalibration, OfVins) {
  write("camera.yaml", kVinsCamera);
  damage(kVinsRig);
}
TEST_F(DamagedCalibration, OfMiddlebury) { damage(kMiddlebury); }
TEST_F(DamagedCalibration, OfOpenCv) {
  test::SyntheticPair pair;
  pair.width = 64;
  pair.height = 48;
  pair.focal = 50;
  damage(pair.text());
  damage(
      "%YAML:1.0\n---\nQ: !!opencv-matrix\n   rows: 4\n   cols: 4\n   dt: d\n   data: [ 1., 0., 0., -32., "
      "0., 1., 0., "
      "-24., 0., 0., 0., 50., 0., 0., 8., 4. ]\n");
}

}  // namespace damaged_calibration_test
}  // namespace parallax
