// SPDX-License-Identifier: Apache-2.0
#include "platform/input/calibration.hpp"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

#include "tests/paths.hpp"
#include "tests/platform/test_calibrations.hpp"

namespace parallax {
namespace calibration_test {

using test::message;
using test::SyntheticPair;
using test::with_entry;

class CalibrationTest : public test::FolderTest {
 protected:
  // The line for a calibration in which one entry has been replaced, without the file name.
  std::string changed(const std::string& name, const std::string& line,
                      const SyntheticPair& pair = {}) const {
    const std::string file = write("c.yml", with_entry(pair.text(), name, line));
    const std::string text = message([&] { read_calibration({file}); });
    const std::string prefix = file + ": ";
    EXPECT_EQ(text.substr(0, prefix.size()), prefix);
    EXPECT_EQ(text.find('\n'), std::string::npos);
    return text.size() > prefix.size() ? text.substr(prefix.size()) : text;
  }
};

TEST_F(CalibrationTest, ReadsTheSharedOnes) {
  for (const char* scene : {"euroc_v101", "opencv_chessboard01", "kitti_seq2"}) {
    const std::string file = test::shared_data(scene) + "/calib.yml";
    if (!std::filesystem::exists(file)) {
      GTEST_SKIP() << "no shared data";
    }
    const Calibration c = read_calibration({file});
    EXPECT_TRUE(c.metric());
    EXPECT_GT(c.baseline(), 0.1);
    EXPECT_EQ(c.model, std::string(scene) == "kitti_seq2" ? LensModel::kRectified : LensModel::kPinhole);
    // The file's own Q is what P1 and P2 give.
    EXPECT_LT(cv::norm(c.Q - disparity_to_depth(c.P1, c.P2)), 1e-4);
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
  EXPECT_NEAR(computed.baseline(), 0.1101, 1e-4);
}

TEST_F(CalibrationTest, EveryPinholeAndFisheyeModelIsRead) {
  SyntheticPair pair;
  for (const std::size_t count : {4, 5, 8, 12, 14}) {
    pair.distortion.resize(count);
    const Calibration c = read_calibration({write("c.yml", pair.text())});
    EXPECT_EQ(c.left.distortion.size(), count);
    EXPECT_NEAR(c.baseline(), 0.1, 1e-3);
    EXPECT_EQ(c.unit, "m");
  }
  const Calibration c = read_calibration({write("c.yml", test::fisheye_pair().text())});
  EXPECT_EQ(c.model, LensModel::kFisheye);
  EXPECT_NEAR(c.baseline(), 0.1, 1e-3);
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
  EXPECT_NEAR(c.baseline(), 0.1, 1e-3);
  EXPECT_NEAR(c.Q(3, 2), 10, 0.1);
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
            files[0] + " + " + files[1] + ": image_width and image_height are missing");
}

TEST_F(CalibrationTest, ARectifiedPairNeedsNothingButItsSize) {
  const Calibration c =
      read_calibration({write("c.yml", "%YAML:1.0\n---\ncamera_model: rectified\nimage_size: [640, 480]\n")});
  EXPECT_EQ(c.size.width, 640);
  EXPECT_FALSE(c.metric());
  SyntheticPair pair;
  pair.model = "rectified";
  EXPECT_NEAR(read_calibration({write("d.yml", pair.text())}).baseline(), 0.1, 1e-3);
}

TEST_F(CalibrationTest, MissingOrGarbledEntriesAreNamed) {
  EXPECT_EQ(changed("K1", ""), "K1 is missing");
  EXPECT_EQ(changed("D2", ""), "D2 is missing");
  EXPECT_EQ(changed("R", ""), "R is missing");
  EXPECT_EQ(changed("T", ""), "T is missing");
  EXPECT_EQ(changed("image_height", ""), "image_height is missing");
  EXPECT_EQ(changed("K1", "K1: hello"), "K1 is not a matrix of numbers");
  EXPECT_EQ(changed("K1", "K1: [1, 2, 3]"), "K1 has 3x1 elements, 3x3 expected");
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
  EXPECT_EQ(changed("T_unit", "R1: [0, 0, 0]"), "R2 is missing");
}

TEST_F(CalibrationTest, ImpossibleRigsAreNamed) {
  EXPECT_EQ(changed("T", "T: [0.1, 0, 0]"),
            "P2: the right camera is not to the right of the left one; are the images exchanged?");
  EXPECT_EQ(changed("T", "T: [0, -0.1, 0]"),
            "P2: the cameras are above each other; only side by side cameras are supported");
}

TEST_F(CalibrationTest, WhatIsNoCalibrationIsNamed) {
  for (const char* text :
       {"", "hello", "%YAML:1.0\n---\nK1: [1, 2", "<?xml version=\"1.0\"?><a><b>", "{\"K1\": ["}) {
    const std::string file = write("bad.yml", text);
    const std::string line = message([&] { read_calibration({file}); });
    EXPECT_EQ(line.find(file + ": not an OpenCV YAML, XML or JSON file"), 0U) << "[" << text << "] " << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
  EXPECT_EQ(message([&] { read_calibration({path("none.yml")}); }),
            path("none.yml") + ": cannot read: No such file or directory");
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
