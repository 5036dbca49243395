// SPDX-License-Identifier: Apache-2.0
// The program with calibrations of other formats: what they say of one and the same rig is one and the same
// cloud.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/cli/program.hpp"

namespace parallax {
namespace calibration_formats_test {

class CalibrationFormats : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(program_("scene --rectified --size 96x64 --disparities 32 --out in").code, 0);
  }

  test::Outcome run(const std::string& calibration) const {
    return program_(
        "run -d 32 --no-verdict --left in/left.png --right in/right.png --out out --calibration " +
        calibration);
  }
  // points.ply with this calibration.
  std::string cloud(const std::string& calibration) const {
    const test::Outcome outcome = run(calibration);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return program_.read("out/points.ply");
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(program_ / name) << text;
  }

  test::Program program_;
};

// A rig with f = 128 px, the principal point (48, 32) and a baseline of 0.125 m: all numbers are exact.
constexpr const char* kQ =
    "%YAML:1.0\n---\nQ: !!opencv-matrix\n   rows: 4\n   cols: 4\n   dt: d\n   data: [ 1, 0, 0, -48, 0, 1, 0, "
    "-32, 0, 0, 0, "
    "128, 0, 0, 8, 0 ]\n";

TEST_F(CalibrationFormats, OneRigIsOneCloud) {
  write("q.yml", kQ);
  const std::string expected = cloud("q.yml");
  EXPECT_GT(expected.size(), 15'000U);
  // 128 * 0.125 = 16; cameras 2 and 3 stand 0.0625 to the left and 0.0625 to the right of camera 0.
  write("calib.txt",
        "P0: 128 0 48 0 0 128 32 0 0 0 1 0\nP1: 128 0 48 -16 0 128 32 0 0 0 1 0\nP2: 128 0 48 8 0 128 32 0 0 "
        "0 1 0\nP3: 128 "
        "0 48 -8 0 128 32 0 0 0 1 0\n");
  EXPECT_EQ(cloud("calib.txt --cameras 0,1"), expected);
  EXPECT_EQ(cloud("calib.txt --cameras 2,3"), expected);
  const auto camera_info = [](const std::string& tx) {
    return "width: 96\nheight: 64\ndistortion_model: plumb_bob\nD: [0, 0, 0, 0, 0]\nK: [128, 0, 48, 0, 128, "
           "32, 0, 0, 1]\n"
           "R: [1, 0, 0, 0, 1, 0, 0, 0, 1]\nP: [128, 0, 48, " +
           tx + ", 0, 128, 32, 0, 0, 0, 1, 0]\n";
  };
  write("left.yaml", camera_info("0"));
  write("right.yaml", camera_info("-16"));
  EXPECT_EQ(cloud("left.yaml right.yaml"), expected);
  EXPECT_EQ(cloud("left.yaml --calibration right.yaml"), expected) << "an option for each file";
  // Millimetres: another cloud, of as many points.
  write("middlebury.txt",
        "cam0=[128 0 48; 0 128 32; 0 0 1]\ncam1=[128 0 48; 0 128 32; 0 0 "
        "1]\ndoffs=0\nbaseline=125\nwidth=96\nheight=64\n");
  EXPECT_EQ(cloud("middlebury.txt").size(), expected.size());
}

TEST_F(CalibrationFormats, WhichOfSeveralCamerasIsSaid) {
  std::string four;
  for (const auto& [name, x] : {std::pair("P0", "0"), {"P1", "-16"}, {"P2", "8"}, {"P3", "-8"}})
    four += std::string(name) + ": 128 0 48 " + x + " 0 128 32 0 0 0 1 0\n";
  write("calib.txt", four);
  const std::string said =
      "parallax: note: calib.txt: of its cameras 0, 1, 2 and 3, 0 and 1 are taken; --cameras 2,3 takes "
      "others\n";
  EXPECT_EQ(run("calib.txt").err, said);
  EXPECT_EQ(run("calib.txt --cameras 0,1").err, "");
  EXPECT_EQ(program_("map encode --size 96x64 -o m --calibration calib.txt").err, said);
  write("calib.txt", four.substr(four.find("P2")));
  EXPECT_EQ(
      run("calib.txt").err,
      "parallax: error: calib.txt: holds the cameras 2 and 3, and 0 and 1 are taken if nothing is said: "
      "--cameras 2,3\n");
  EXPECT_EQ(run("calib.txt --cameras 2,5").err,
            "parallax: error: calib.txt: holds no camera 5, but 2 and 3\n");
}

TEST_F(CalibrationFormats, DisparitiesThatMeanNothingAreLeftOutAndSaidSo) {
  // The principal points are 12 px apart: a point at infinity has the disparity 12.
  write("middlebury.txt",
        "cam0=[128 0 48; 0 128 32; 0 0 1]\ncam1=[128 0 36; 0 128 32; 0 0 "
        "1]\ndoffs=-12\nbaseline=125\nwidth=96\nheight=64\n");
  const test::Outcome outcome = run("middlebury.txt");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err,
            "parallax: note: middlebury.txt: a point at infinity has the disparity 12.00 px, as the "
            "principal points are so "
            "far apart: points.ply leaves out what has a smaller one, which would lie behind the camera\n");
  const std::string ply = program_.read("out/points.ply");
  EXPECT_NE(ply.find("\ncomment left out: "), std::string::npos) << ply.substr(0, 300);
  const std::string timing_only =
      "run -d 32 --timing-only --left in/left.png --right in/right.png --calibration middlebury.txt";
  EXPECT_EQ(program_(timing_only).err, "") << "there is no cloud";
}

TEST_F(CalibrationFormats, ChoosingCamerasNeedsACalibration) {
  EXPECT_EQ(program_("run --cameras 2,3").err, "parallax: error: --cameras needs --calibration\n");
  EXPECT_EQ(run("in/calib.yml --cameras 2").err,
            "parallax: error: --cameras: \"2\" is not a left and a right camera such as 2,3\n");
}

}  // namespace calibration_formats_test
}  // namespace parallax
