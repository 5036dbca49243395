// SPDX-License-Identifier: Apache-2.0
// Options, calibrations and maps that are wrong: one line on standard error, exit code 2, nothing on standard
// output, and nothing left behind.
#include <gtest/gtest.h>

#include "tests/cli/bad_input.hpp"

namespace parallax {
namespace bad_input_test {

namespace fs = std::filesystem;
using test::BadInput;

TEST_F(BadInput, Configuration) {
  EXPECT_EQ(pair_error("--set matching.p3=1").rfind("--set matching.p3=1: unknown key matching.p3", 0), 0U);
  EXPECT_NE(pair_error("--set matching.p3=1").find("matching.p"), std::string::npos);
  EXPECT_NE(pair_error("--set matching.p1=256").find("256"), std::string::npos);
  EXPECT_NE(pair_error("--set matching.p1=42").find("matching.p1"), std::string::npos);
  EXPECT_NE(pair_error("--set matching.disparity_offset=250").find("matching.disparity_offset"),
            std::string::npos);
  EXPECT_EQ(pair_error("--disparities 100"),
            "--disparities 100: must be a positive multiple of matching.parallelism = 32; the nearest are 96 "
            "and 128");
  EXPECT_EQ(pair_error("--set camera.frame_rate=1e-9")
                .rfind("camera.frame_rate = 1e-09: must be 0 or at least 0.001 frames/s", 0),
            0U);
  EXPECT_EQ(pair_error("--set camera.skew_ns=2000000"),
            "camera.skew_ns = 2000000: must be at most camera.skew_limit_ns = 1000000, or no two images are "
            "one frame "
            "(camera.skew_ns: --set camera.skew_ns=2000000)");
  EXPECT_EQ(pair_error("--set camera.early_start_rows=5 --set camera.fault=missing_row"),
            "camera.early_start_rows = 5: must be 0 with a camera.fault, which shows when the core has begun "
            "the frame "
            "(camera.early_start_rows: --set camera.early_start_rows=5, camera.fault: --set "
            "camera.fault=missing_row)");
  EXPECT_EQ(pair_error("--set camera.jitter_ns=5"),
            "camera.jitter_ns = 5: needs a camera.frame_rate above 0, exposures have no dates to miss "
            "(camera.jitter_ns: --set camera.jitter_ns=5)");
  EXPECT_EQ(
      pair_error("--set camera.jitter_ns=10000000 --set camera.frame_rate=100"),
      "camera.jitter_ns = 10000000: must be below the period of camera.frame_rate, 10000000 ns "
      "(camera.frame_rate: --set camera.frame_rate=100, camera.jitter_ns: --set camera.jitter_ns=10000000)");
  // 48 rows of 64 pixels and 32 of blanking, and 2048 after the frame.
  EXPECT_EQ(
      error("--size 64x48 --set clocks.camera_hz=1e6 --set camera.frame_rate=151"),
      "camera.frame_rate = 151: reading out 64x48 px takes 6656 pixel clocks, which allows at most 150.24 "
      "frames/s");
  EXPECT_NE(pair_error("--preset scenescan-por").find("scenescan-pro"), std::string::npos);
}

TEST_F(BadInput, OptionsThatContradict) {
  EXPECT_EQ(error("--left left.png"), "--right is missing: a pair needs --left and --right");
  EXPECT_EQ(error("--right right.png"), "--left is missing: a pair needs --left and --right");
  EXPECT_EQ(pair_error("--input ."), "--input and --left/--right exclude each other");
  EXPECT_EQ(pair_error("--map a.map --calibration c.yml"),
            "--map and --calibration exclude each other: both say how to rectify");
  EXPECT_EQ(pair_error("--fit"), "--fit needs --calibration");
  EXPECT_EQ(pair_error("--size 64x48"),
            "--size and --rectified are for the built-in scene, but images are given");
  EXPECT_EQ(pair_error("--seed 5"), "--seed is for the built-in scene, but images are given");
  EXPECT_EQ(pair_error("--frames -1"), "--frames is -1, allowed is 1 to 1000000000");
  EXPECT_EQ(pair_error("--frames 0"), "--frames is 0, allowed is 1 to 1000000000");
  EXPECT_EQ(pair_error("--timing-frames 0"), "--timing-frames is 0, allowed is 1 to 1000000000");
  EXPECT_EQ(error("--size 64"), "--size: '64' is not a size such as 640x480");
  EXPECT_EQ(error("--leftt left.png"), "unknown option --leftt; the nearest is --left");
  EXPECT_EQ(error("left.png"), "unexpected argument 'left.png'");
  EXPECT_EQ(error("--size 64x48 --set image.width=64"),
            "--size and image.width or image.height exclude each other: both say how large the scene is");
  EXPECT_EQ(error("--size 64x48 --seed -1"), "--seed: '-1' is not a whole number of at most 18 digits");
  EXPECT_EQ(error("--size 64x48 --seed 99999999999999999999"),
            "--seed: '99999999999999999999' is not a whole number of at most 18 digits");
  EXPECT_NE(error("--frames many"), "");
  EXPECT_NE(error("--left"), "");
  EXPECT_EQ(error("--left '' --right ''"), "--left: the value is empty");
  EXPECT_EQ(error("--size 64x48 --out ''"), "--out: the value is empty");
  EXPECT_NE(error("--frames 99999999999999999999").find("allowed is 1 to 1000000000"), std::string::npos);
}

TEST_F(BadInput, TimingOnlyHasNoImages) {
  for (const std::string option : {"--ground-truth truth.png", "--no-point-cloud"}) {
    EXPECT_EQ(pair_error("--timing-only " + option),
              "--timing-only computes no images: it cannot go with " + option.substr(0, option.find(' ')));
  }
  EXPECT_EQ(pair_error("--timing-only --mask mask.png"),
            "--timing-only computes no images: it cannot go with --mask");
  EXPECT_EQ(pair_error("--timing-only --set matching.p1=256").rfind("--set matching.p1=256: ", 0), 0U);
  EXPECT_EQ(error("--timing-only --left none.png --right right.png"), "image none.png does not exist");
}

TEST_F(BadInput, Calibration) {
  ASSERT_EQ(program_("scene --size 96x64 --disparities 32 --out scene").code, 0);
  text("broken.yml", "%YAML:1.0\n---\nK1: [");
  text("poor.yml", "%YAML:1.0\n---\nK1: 5\n");
  EXPECT_EQ(pair_error("--calibration none.yml"), "none.yml: cannot read: No such file or directory");
  EXPECT_EQ(pair_error("--calibration scene/calib.yml"),
            "scene/calib.yml: the calibration is for images of 96x64, these have 64x48");
  EXPECT_EQ(pair_error("--calibration broken.yml").rfind("broken.yml: ", 0), 0U);
  EXPECT_EQ(pair_error("--calibration poor.yml").rfind("poor.yml: ", 0), 0U);
}

TEST_F(BadInput, Map) {
  ASSERT_EQ(program_("map encode --identity 64x48 -o good.map").code, 0);
  ASSERT_EQ(program_("map encode --identity 64x32 -o other.map").code, 0);
  ASSERT_EQ(program_("map encode --identity 64x48 --window 41 -o window.map").code, 0);
  fs::copy_file(program_ / "good.map", program_ / "short.map");
  truncate("short.map", 100);
  std::string bytes = program_.read("good.map");
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  text("flipped.map", bytes);
  EXPECT_EQ(pair_error("--map none.map"), "none.map: cannot read: No such file or directory");
  EXPECT_EQ(pair_error("--map left.png"),
            "left.png: not a rectification map: the first four bytes are not PLXM");
  EXPECT_EQ(pair_error("--map short.map").rfind("short.map: truncated rectification map", 0), 0U);
  EXPECT_EQ(pair_error("--map flipped.map").rfind("flipped.map: corrupt rectification map", 0), 0U);
  EXPECT_EQ(pair_error("--map other.map"), "other.map: a map of 64x32 px, but the images have 64x48");
  EXPECT_EQ(pair_error("--map window.map").rfind("window.map: a map for window 41", 0), 0U);
}

}  // namespace bad_input_test
}  // namespace parallax
