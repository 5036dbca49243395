// SPDX-License-Identifier: Apache-2.0
// KITTI's files, of rectified and of raw images. The numbers are made up, but for the pair of colour cameras.
#include "platform/input/kitti_calibration.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <tuple>

#include "platform/input/kitti_raw_calibration.hpp"
#include "platform/input/read_calibration.hpp"
#include "tests/platform/test_calibrations.hpp"

namespace parallax {
namespace kitti_calibration_test {

using test::message;

std::string projection(const std::string& name, const std::string& x, const std::string& y = "0",
                       const std::string& z = "0") {
  return name + ": 7.070493e+02 0.000000e+00 6.040814e+02 " + x + " 0.000000e+00 7.070493e+02 1.805066e+02 " +
         y + " 0.000000e+00 0.000000e+00 1.000000e+00 " + z + "\n";
}

std::string rectified_text() {
  return projection("P0", "0") + projection("P1", "-3.535246500000e+02") +
         projection("P2", "4.575831e+01", "-3.454157e-01", "4.981016e-03") +
         projection("P3", "-3.341081e+02", "2.330660e+00", "3.201153e-03") +
         "R0_rect: 1 0 0 0 1 0 0 0 1\nTr_velo_to_cam: 0 -1 0 0\n";
}

// Cameras with parallel axes, 0.5 m apart; raw images of 300x200, rectified ones of 280x160.
std::string raw_text() {
  std::string text = "calib_time: 09-Jan-2012 13:57:47\ncorner_dist: 9.950000e-02\n";
  for (const auto& [number, x] : {std::pair{"00", "0"}, {"01", "-1.000000e+02"}}) {
    const std::string n = number;
    text += "S_" + n + ": 3.000000e+02 2.000000e+02\n";
    text += "K_" + n + ": 2.1e+02 0 1.5e+02 0 2.2e+02 1.0e+02 0 0 1\n";
    text += "D_" + n + ": -3.7e-01 2.0e-01 1.0e-03 5.0e-04 -7.2e-02\n";
    text += "R_" + n + ": 1 0 0 0 1 0 0 0 1\n";
    text += "T_" + n + ": " + (n == "00" ? "0" : "-5.0e-01") + " 0 0\n";
    text += "S_rect_" + n + ": 2.800000e+02 1.600000e+02\n";
    text += "R_rect_" + n + ": 1 0 0 0 1 0 0 0 1\n";
    text += "P_rect_" + n + ": 2.0e+02 0 1.4e+02 " + x + " 0 2.0e+02 8.0e+01 0 0 0 1 0\n";
  }
  return text;
}

class KittiCalibration : public test::FolderTest {
 protected:
  Calibration read(const std::string& text, const ImageSize& images,
                   const std::optional<CameraPair>& cameras = std::nullopt) const {
    return read_calibration({write("calib.txt", text)}, images, cameras);
  }
  std::string line(const std::string& text, const ImageSize& images = {1226, 370},
                   const std::optional<CameraPair>& cameras = std::nullopt) const {
    const std::string whole = message([&] { read(text, images, cameras); });
    const std::string prefix = path("calib.txt") + ": ";
    EXPECT_TRUE(whole.empty() || whole.find(prefix) == 0) << whole;
    EXPECT_EQ(whole.find('\n'), std::string::npos) << whole;
    return whole.empty() ? whole : whole.substr(prefix.size());
  }
  static std::string replaced(std::string text, const std::string& what, const std::string& with) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), with);
  }
};

TEST_F(KittiCalibration, TheGreyPairIfNotSaidOtherwise) {
  const Calibration c = read(rectified_text(), {1226, 370});
  EXPECT_EQ(c.model, LensModel::kRectified);
  EXPECT_EQ(c.unit, "m");
  EXPECT_EQ(c.size.width, 1226) << "that of the images, as the file has none";
  // 353.52465 / 707.0493 = 0.5.
  EXPECT_DOUBLE_EQ(c.geometry->baseline, 0.5);
  EXPECT_DOUBLE_EQ(c.geometry->cy, 180.5066);
  EXPECT_DOUBLE_EQ(c.geometry->doffs(), 0);
}

TEST_F(KittiCalibration, TheColourPairIsRelativeToCameraZero) {
  // (45.75831 + 334.1081) / 707.0493 = 0.5372559 m. The right one is 2.676 / 707.0493 = 3.8 mm above, 0.7 %
  // of that.
  const Calibration c = read(rectified_text(), {1226, 370}, CameraPair{2, 3});
  EXPECT_NEAR(c.geometry->baseline, 0.5372559, 1e-7);
  EXPECT_NEAR(c.geometry->focal_x * c.geometry->baseline / 20, 18.99332, 1e-5);
}

TEST_F(KittiCalibration, WaysToWriteIt) {
  std::string text = rectified_text();
  for (std::size_t end = 0; (end = text.find('\n', end)) != std::string::npos; end += 2)
    text.insert(end, "\r");
  EXPECT_DOUBLE_EQ(read(text, {1226, 370}).geometry->baseline, 0.5);
  EXPECT_DOUBLE_EQ(read("\xef\xbb\xbf" + rectified_text(), {1226, 370}).geometry->baseline, 0.5);
  EXPECT_DOUBLE_EQ(
      read("\n" + replaced(rectified_text(), "P1: 7", "P1:\t  7"), {1226, 370}).geometry->baseline, 0.5);
  // Only the pair that is used needs to be there.
  EXPECT_NEAR(read(rectified_text().substr(rectified_text().find("P2")), {1226, 370}, CameraPair{2, 3})
                  .geometry->baseline,
              0.5372559, 1e-7);
}

TEST_F(KittiCalibration, DamageIsNamed) {
  const std::string text = rectified_text();
  EXPECT_EQ(line(text.substr(text.find("P1"), text.find("P2") - text.find("P1"))), "P0 is missing");
  EXPECT_EQ(line(text.substr(0, text.find("P1"))), "P1 is missing");
  EXPECT_EQ(line(replaced(text, "P1: 7.070493e+02", "P1:")), "P1 has 11 numbers, 12 expected");
  EXPECT_EQ(line(replaced(text, "P1: 7.070493e+02", "P1: 7,5x")), "P1: \"5x\" is not a number");
  EXPECT_EQ(line(replaced(text, "P1: 7.070493e+02", "P1: nan")),
            "P1 holds a value that is not a finite number");
  EXPECT_EQ(line(replaced(text, "P1: 7.070493e+02", "P1: 1e400")),
            "P1 holds a value that is not a finite number");
  EXPECT_EQ(line(replaced(text, "P1: 7.070493e+02", "P1: -7.070493e+02")),
            "P0, P1: focal lengths -707.0493 and 707.0493 px; those of a rectified image are from 1 to "
            "10000000 px; of its cameras 0, 1, 2 and 3, 0 and 1 are taken; --cameras 2,3 takes others");
  EXPECT_EQ(line(replaced(rectified_text().substr(0, text.find("P2")), "P1", "P0")),
            "P0 occurs twice, with other numbers");
  EXPECT_EQ(line(text, {}), "states no image size; give it with --size");
  EXPECT_EQ(line(text, {1226, 370}, CameraPair{1, 0}),
            "P1, P0: the right camera lies 0.5 to the left of the left one; are the images exchanged?");
  const std::string file = write("calib.txt", text);
  EXPECT_EQ(message([&] {
              read_calibration({file, file}, {1226, 370});
            }),
            file + " + " + file + ": KITTI calib.txt is one file for both cameras, not 2");
}

TEST_F(KittiCalibration, TheImagesSizeTellsRawFromRectified) {
  // 100 / 200 = 0.5 m, either way.
  const Calibration rectified = read(raw_text(), {280, 160});
  EXPECT_EQ(rectified.model, LensModel::kRectified);
  EXPECT_DOUBLE_EQ(rectified.geometry->baseline, 0.5);
  for (const ImageSize& images : {ImageSize{300, 200}, ImageSize{}}) {
    const Calibration raw = read(raw_text(), images);
    EXPECT_EQ(raw.model, LensModel::kPinhole);
    EXPECT_EQ(raw.size.width, 300);
    EXPECT_EQ(raw.size.height, 200);
    EXPECT_EQ(raw.left.camera, cv::Matx33d(210, 0, 150, 0, 220, 100, 0, 0, 1));
    EXPECT_EQ(raw.left.distortion, (std::vector<double>{-0.37, 0.2, 0.001, 0.0005, -0.072}));
    EXPECT_EQ(raw.P2, cv::Matx34d(200, 0, 140, -100, 0, 200, 80, 0, 0, 0, 1, 0));
    EXPECT_DOUBLE_EQ(raw.geometry->baseline, 0.5);
  }
  EXPECT_EQ(line(raw_text(), {640, 480}),
            "the calibration is for raw images of 300x200 or rectified ones of 280x160, these have 640x480");
}

TEST_F(KittiCalibration, DamageOfARawFileIsNamed) {
  EXPECT_EQ(line(replaced(raw_text(), "R_rect_01", "X"), {300, 200}), "R_rect_01 is missing");
  EXPECT_EQ(line(replaced(raw_text(), "R_rect_01", "X"), {280, 160}), "") << "rectified images need none";
  EXPECT_EQ(line(replaced(raw_text(), "R_rect_01: 1", "R_rect_01: 3"), {300, 200}),
            "R_rect_01: not a rotation matrix");
  EXPECT_EQ(line(replaced(raw_text(), "K_01", "X"), {300, 200}), "K_01 is missing");
  EXPECT_EQ(line(replaced(raw_text(), "K_01: 2.1e+02", "K_01: -1"), {300, 200}),
            "K_01: not a camera matrix: focal lengths -1 and 220 px, last element 1");
  EXPECT_EQ(line(replaced(raw_text(), "D_01: -3.7e-01", "D_01:"), {300, 200}),
            "D_01 has 4 numbers, 5 expected");
  EXPECT_EQ(line(replaced(raw_text(), "S_01: 3", "S_01: 4"), {300, 200}),
            "S_01: 400x200, but S_00 is 300x200; the images of a pair have one size");
  EXPECT_EQ(line(replaced(raw_text(), "S_00: 3.000000e+02", "S_00: 3.5"), {300, 200}),
            "S_00: 3.5x200 is not an image size");
  EXPECT_EQ(line(raw_text(), {280, 160}, CameraPair{2, 3}), "holds no camera 2, but 0 and 1");
}

TEST_F(KittiCalibration, CamerasThatAreOrAreNotThere) {
  const std::string text = rectified_text();
  EXPECT_EQ(line(text.substr(text.find("P1"))),
            "holds the cameras 1, 2 and 3, and 0 and 1 are taken if nothing is said: --cameras 2,3");
  EXPECT_EQ(line(text.substr(text.find("P2"))),
            "holds the cameras 2 and 3, and 0 and 1 are taken if nothing is said: --cameras 2,3");
  EXPECT_EQ(line(text, {1226, 370}, CameraPair{2, 4}), "holds no camera 4, but 0, 1, 2 and 3");
  const Calibration c = read(text, {1226, 370});
  EXPECT_EQ(c.choice, "of its cameras 0, 1, 2 and 3, 0 and 1 are taken; --cameras 2,3 takes others");
  EXPECT_EQ(
      message([&] {
        check_size(c, {1224, 370});
      }),
      path("calib.txt") +
          ": the calibration is for images of 1226x370, these have 1224x370; of its cameras 0, 1, 2 and "
          "3, 0 and 1 are taken; --cameras 2,3 takes others");
  EXPECT_EQ(read(text, {1226, 370}, CameraPair{0, 1}).choice, "") << "it was asked for";
  EXPECT_EQ(read(text.substr(0, text.find("P2")), {1226, 370}).choice, "");
}

// Three cameras whose R and T are from camera 0: 1 is turned by 90 degrees about z (x_1 = y_0, y_1 = -x_0)
// and 0.5 m along +x of camera 0; 2 is turned alike and 0.75 m along +y of camera 0, which is +x of camera 1.
std::string unrectified_text() {
  std::string text = "calib_time: 09-Jan-2012 13:57:47\n";
  const std::string turned = "0 1 0 -1 0 0 0 0 1";
  // T = -R c of a camera at c: of (0.5, 0, 0) it is (0, 0.5, 0), of (0.5, 0.75, 0) it is (-0.75, 0.5, 0).
  for (const auto& [number, r, t] : {std::tuple("00", std::string("1 0 0 0 1 0 0 0 1"), "0 0 0"),
                                     {"01", turned, "0 5.0e-01 0"},
                                     {"02", turned, "-7.5e-01 5.0e-01 0"}}) {
    const std::string n = number;
    text +=
        "S_" + n + ": 3.000000e+02 2.000000e+02\nK_" + n + ": 2.1e+02 0 1.5e+02 0 2.2e+02 1.0e+02 0 0 1\n";
    text += "D_" + n + ": 0 0 0 0 0\nR_" + n + ": " + r + "\nT_" + n + ": " + t + "\n";
  }
  return text;
}

TEST_F(KittiCalibration, WithoutARectificationThePairIsPlacedByRAndT) {
  const Calibration c = read(unrectified_text(), {300, 200}, CameraPair{1, 2});
  EXPECT_EQ(c.model, LensModel::kPinhole);
  EXPECT_EQ(c.size.width, 300);
  EXPECT_EQ(c.right.camera, cv::Matx33d(210, 0, 150, 0, 220, 100, 0, 0, 1));
  EXPECT_LT(cv::norm(c.R1 - cv::Matx33d::eye()), 1e-9) << "both are turned alike";
  EXPECT_NEAR(c.geometry->baseline, 0.75, 1e-9);
  // Not turned, and at the same place.
  std::string straight = unrectified_text();
  straight = replaced(straight, "R_01: 0 1 0 -1 0 0 0 0 1\nT_01: 0 5.0e-01 0",
                      "R_01: 1 0 0 0 1 0 0 0 1\nT_01: -5.0e-01 0 0");
  EXPECT_NEAR(read(straight, {300, 200}).geometry->baseline, 0.5, 1e-9);
  EXPECT_EQ(line(replaced(straight, "T_01", "X"), {300, 200}), "T_01 is missing");
  EXPECT_EQ(line(replaced(straight, "R_01: 1", "R_01: 3"), {300, 200}), "R_01: not a rotation matrix");
  EXPECT_EQ(message([&] {
              check_size(read(straight, {280, 160}, CameraPair{0, 1}), {280, 160});
            }),
            path("calib.txt") + ": the calibration is for images of 300x200, these have 280x160");
}

}  // namespace kitti_calibration_test
}  // namespace parallax
