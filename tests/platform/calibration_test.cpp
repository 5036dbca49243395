// SPDX-License-Identifier: Apache-2.0
#include "platform/input/read_calibration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/calib3d.hpp>

#include "tests/paths.hpp"
#include "tests/platform/test_calibrations.hpp"

namespace parallax {
namespace calibration_test {

using test::message;
using test::SyntheticPair;
using test::with_entry;

class CalibrationTest : public test::ChangedCalibrationTest {};

TEST_F(CalibrationTest, ReadsTheSharedOnes) {
  for (const char* scene : {"euroc_v101", "opencv_chessboard01", "kitti_seq2"}) {
    const std::string file = test::shared_data(scene) + "/calib.yml";
    if (!std::filesystem::exists(file)) {
      GTEST_SKIP() << "no shared data";
    }
    const Calibration c = read_calibration({file});
    ASSERT_TRUE(c.geometry);
    EXPECT_GT(c.geometry->baseline, 0.1);
    EXPECT_EQ(c.model, std::string(scene) == "kitti_seq2" ? LensModel::kRectified : LensModel::kPinhole);
    // The file's own Q is what P1 and P2 give.
    cv::Mat q;
    cv::FileStorage(file, cv::FileStorage::READ)["Q"] >> q;
    EXPECT_LT(cv::norm(cv::Matx44d(q.ptr<double>()) - disparity_to_depth(*c.geometry)), 1e-4);
  }
}

TEST_F(CalibrationTest, ComputesWhatTheFileLeavesOut) {
  const std::string file = test::shared_data("euroc_v101/calib.yml");
  if (!std::filesystem::exists(file)) {
    GTEST_SKIP() << "no shared data";
  }
  std::ifstream stream(file);
  std::string text((std::istreambuf_iterator<char>(stream)), {});
  for (const char* entry : {"R1", "R2", "P1", "P2", "Q"}) {
    text = with_entry(text, entry, "");
  }
  const Calibration stated = read_calibration({file});
  const Calibration computed = read_calibration({write("c.yml", text)});
  EXPECT_LT(cv::norm(stated.R1 - computed.R1), 1e-9);
  EXPECT_LT(cv::norm(stated.R2 - computed.R2), 1e-9);
  EXPECT_LT(cv::norm(stated.P1 - computed.P1), 1e-3);
  EXPECT_LT(cv::norm(stated.P2 - computed.P2), 1e-3);
  EXPECT_NEAR(computed.geometry->baseline, 0.1101, 1e-4);
}

TEST_F(CalibrationTest, EveryPinholeAndFisheyeModelIsRead) {
  SyntheticPair pair;
  for (const std::size_t count : {4, 5, 8, 12, 14}) {
    pair.distortion.resize(count);
    const Calibration c = read_calibration({write("c.yml", pair.text())});
    EXPECT_EQ(c.left.distortion.size(), count);
    EXPECT_NEAR(c.geometry->baseline, 0.1, 1e-3);
    EXPECT_EQ(c.unit, "m");
  }
  const Calibration c = read_calibration({write("c.yml", test::fisheye_pair().text())});
  EXPECT_EQ(c.model, LensModel::kFisheye);
  EXPECT_NEAR(c.geometry->baseline, 0.1, 1e-3);
}

TEST_F(CalibrationTest, AVeryWideFisheyeKeepsItsFocalLength) {
  SyntheticPair pair = test::fisheye_pair();
  pair.width = 848;
  pair.height = 800;
  pair.focal = 286;
  pair.distortion = {-0.008, 0.04, -0.037, 0.006};
  const Calibration c = read_calibration({write("c.yml", pair.text())});
  EXPECT_NEAR(c.P1(0, 0), 286, 1);
  EXPECT_EQ(c.P1(0, 2), 423.5);
  EXPECT_EQ(c.P1(1, 2), 399.5);
  EXPECT_NEAR(c.geometry->baseline, 0.1, 1e-3);
}

TEST_F(CalibrationTest, ReadsIntrinsicsAndExtrinsicsOfTheStereoCalibSample) {
  const SyntheticPair pair;
  const Calibration whole = read_calibration({write("c.yml", pair.text())});
  {
    cv::FileStorage file(path("intrinsics.yml"), cv::FileStorage::WRITE);
    file << "M1" << pair.camera(0) << "D1" << pair.coefficients() << "M2" << pair.camera(1) << "D2"
         << pair.coefficients();
    cv::FileStorage other(path("extrinsics.xml"), cv::FileStorage::WRITE);
    cv::Mat vector;
    cv::Rodrigues(SyntheticPair::rotation(), vector);
    other << "R" << vector << "T" << SyntheticPair::translation();
  }
  const std::vector<std::string> files = {path("intrinsics.yml"), path("extrinsics.xml")};
  const Calibration parts = read_calibration(files, {640, 480});
  EXPECT_LT(cv::norm(parts.P2 - whole.P2), 1e-9);
  EXPECT_LT(cv::norm(parts.R1 - whole.R1), 1e-9);
  EXPECT_EQ(message([&] { read_calibration(files); }),
            files[0] + " + " + files[1] + ": states no image size; give it with --size");
}

TEST_F(CalibrationTest, MissingOrGarbledEntriesAreNamed) {
  EXPECT_EQ(changed("K1", ""), "K1 is missing");
  EXPECT_EQ(changed("D2", ""), "D2 is missing");
  EXPECT_EQ(changed("R", ""), "R is missing");
  EXPECT_EQ(changed("T", ""), "T is missing");
  EXPECT_EQ(changed("image_height", ""), "image_height is missing");
  EXPECT_EQ(changed("K1", "K1: hello"), "K1 is not a matrix of numbers");
  EXPECT_EQ(changed("K1", "K1: [1, 2, 3]"), "K1 has 3x1 elements, 3x3 expected");
  EXPECT_EQ(
      changed("K1", "K1: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 1, 0, 0, 0, 1 ]"),
      "K1 has rows: 3 and cols: 3, but 5 numbers");
  EXPECT_EQ(changed("T", "T: [.nan, 0, 0]"), "T holds a value that is not a finite number");
  EXPECT_EQ(changed("T", "T: [0, 0, 0]"), "T: the baseline is zero");
  EXPECT_EQ(changed("R", "R: [.inf, 0, 0]"), "R holds a value that is not a finite number");
  EXPECT_EQ(
      changed(
          "K2",
          "K2: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 0., 0, 1, 0, 5, 1, 0, 0, 1 ]"),
      "K2: not a camera matrix: focal lengths 0 and 5 px, last element 1");
  EXPECT_EQ(
      changed(
          "R",
          "R: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 1., 0, 1, 0, 1, 1, 0, 0, 1 ]"),
      "R: not a rotation matrix");
  EXPECT_EQ(changed("D1", "D1: [0.1, 0.2, 0.3]"),
            "D1: 3 coefficients, 4, 5, 8, 12, 14 expected for this camera model");
  EXPECT_EQ(changed("D1", "D1: [0.1, 0.2, 0.3, 0.4, 0.5]", test::fisheye_pair()),
            "D1: 5 coefficients, 4 expected for this camera model");
  EXPECT_EQ(changed("camera_model", "camera_model: pinhale"),
            "camera_model: \"pinhale\" is not pinhole_radtan, fisheye_equidistant or rectified");
  EXPECT_EQ(changed("camera_model", "camera_model: 3"), "camera_model is not a text");
  EXPECT_EQ(changed("image_width", "image_width: -5"),
            "image_width, image_height: -5x480 is not an image size");
  EXPECT_EQ(changed("image_width", "image_width: 1e308"),
            "image_width, image_height: 1e+308x480 is not an image size");
  EXPECT_EQ(changed("image_width", "image_width: 640.5"),
            "image_width, image_height: 640.5x480 is not an image size");
  EXPECT_EQ(changed("T_unit", "R1: [0, 0, 0]"), "R2 is missing");
}

TEST_F(CalibrationTest, ImpossibleRigsAreNamed) {
  EXPECT_EQ(
      changed("T", "T: [0.1, 0, 0]"),
      "the rectification of R and T: the right camera lies 0.1 to the left of the left one; are the images "
      "exchanged?");
  EXPECT_EQ(
      changed("T", "T: [0, -0.1, 0]"),
      "T: the cameras are above each other, 0.1 against 0 beside; only side by side cameras are supported");
  EXPECT_EQ(
      changed("T", "T: [0, -0.1, 0]", test::fisheye_pair()),
      "T: the cameras are above each other, 0.1 against 0 beside; only side by side cameras are supported");
}

TEST_F(CalibrationTest, WhatIsNoCalibrationIsNamed) {
  for (const char* text : {"", "hello", "a: b\n", "\x89PNG\r\n\x1a\n"}) {
    const std::string file = write("bad.txt", text);
    EXPECT_EQ(
        message([&] { read_calibration({file}); }),
        file +
            ": not a calibration of a known format: OpenCV FileStorage (YAML with the first line %YAML:1.0, "
            "XML or JSON), ROS camera_info or EuRoC sensor.yaml (two files), Kalibr camchain, KITTI "
            "calib.txt or calib_cam_to_cam.txt, Middlebury calib.txt, VINS-Fusion (its configuration, which "
            "names the files of both cameras), ORB-SLAM3");
  }
  EXPECT_EQ(message([&] { read_calibration({path("none.yml")}); }),
            path("none.yml") + ": cannot read: No such file or directory");
}

TEST_F(CalibrationTest, FilesOfSeveralFormatsAreRefused) {
  const std::string opencv = write("a.yml", SyntheticPair().text());
  const std::string kitti = write("b.txt", "P0: 1 2 3\n");
  EXPECT_EQ(message([&] {
              read_calibration({opencv, kitti});
            }),
            kitti + ": KITTI calib.txt, but " + opencv +
                " is OpenCV FileStorage: one calibration is of one format");
  EXPECT_EQ(message([&] { read_calibration({opencv}, {}, CameraPair{}); }),
            opencv + ": OpenCV FileStorage has no numbered cameras that --cameras could choose from");
}

TEST_F(CalibrationTest, AChoiceOfCamerasIsTwoNumbers) {
  EXPECT_FALSE(camera_pair("--cameras", ""));
  EXPECT_EQ(camera_pair("--cameras", "2,3")->left, 2);
  EXPECT_EQ(camera_pair("--cameras", "101,103")->right, 103);
  for (const char* text : {"2", "2,", "2,2", "-1,2", "2,3,", "a,b", "2 3", "2,3.5"}) {
    EXPECT_EQ(message([&] { camera_pair("--cameras", text); }),
              std::string("--cameras: \"") + text + "\" is not a left and a right camera such as 2,3");
  }
}

TEST_F(CalibrationTest, TheImagesMustHaveItsSize) {
  const Calibration c = read_calibration({write("c.yml", SyntheticPair().text())});
  EXPECT_EQ(message([&] { check_size(c, {640, 480}); }), "");
  EXPECT_EQ(message([&] {
              check_size(c, {752, 480});
            }),
            path("c.yml") + ": the calibration is for images of 640x480, these have 752x480");
}

}  // namespace calibration_test
}  // namespace parallax
