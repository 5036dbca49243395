// SPDX-License-Identifier: Apache-2.0
// What a run says of an input that was taken another way than it was meant.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/cli/program.hpp"
#include "tests/paths.hpp"
#include "tests/platform/python.hpp"

namespace parallax::test {
namespace input_hints_test {

class InputHints : public testing::Test {
 protected:
  /// What a run of the built-in scene's files says on standard error.
  std::string said(const std::string& arguments) const {
    const Outcome outcome = program_("run --no-verdict " + arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.err;
  }
  Program program_;
};

TEST_F(InputHints, ExchangedSides) {
  ASSERT_EQ(program_("scene --rectified --out in").code, 0);
  const std::string hint =
      "parallax: note: few pixels are valid, and left and right look exchanged: what the left image shows "
      "lies "
      "further right in the right image, where it must lie further left\n";
  EXPECT_EQ(said("--left in/right.png --right in/left.png"), hint);
  EXPECT_EQ(said("--left in/left.png --right in/right.png"), "");
  EXPECT_EQ(said("--left in/left.png --right in/right.png --set texture.threshold=63"), "")
      << "little is valid, but for another reason";
  EXPECT_EQ(said("--left in/right.png --right in/left.png -q"), "");
  ASSERT_EQ(program_("scene --out raw").code, 0);
  EXPECT_NE(said("--left raw/right.png --right raw/left.png --calibration raw/calib.yml").find(hint),
            std::string::npos);
  EXPECT_EQ(said("--left raw/left.png --right raw/right.png --calibration raw/calib.yml"), "");
}

TEST_F(InputHints, ExchangedSidesOfRealCameras) {
  for (const char* scene : {"euroc_v101", "kitti_seq2"}) {
    const std::string folder = shared_data(scene);
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no development data";
    const std::string left = folder + "/left_00.png", right = folder + "/right_00.png";
    const std::string rest = " --fit --calibration " + folder + "/calib.yml";
    EXPECT_NE(said("--left " + right + " --right " + left + rest).find("look exchanged"), std::string::npos);
    EXPECT_EQ(said("--left " + left + " --right " + right + rest).find("look exchanged"), std::string::npos);
  }
}

TEST_F(InputHints, AGroundTruthOfAnotherScale) {
  ASSERT_EQ(program_("scene --rectified --size 320x240 --out in").code, 0);
  const std::string pair = "--left in/left.png --right in/right.png --ground-truth in/disp_gt.png ";
  EXPECT_EQ(said(pair),
            "parallax: note: ground truth in/disp_gt.png: 16-bit integers, taken as disparity * 256; "
            "--ground-truth-scale states another\n");
  EXPECT_EQ(said(pair + "--ground-truth-scale 256"), "");
  EXPECT_EQ(said(pair + "--ground-truth-scale 16"),
            "parallax: note: the ground truth looks like one of another scale: nearly all of it is off by "
            "one factor, "
            "and --ground-truth-scale 256 instead of 16 would fit\n");
  EXPECT_EQ(said("--size 320x240"), "") << "the built-in scene has no scale";
}

TEST_F(InputHints, DepthInThePlaceOfDisparity) {
  if (!python_has("numpy, PIL")) GTEST_SKIP() << "no python3-numpy or python3-pil";
  ASSERT_EQ(program_("scene --rectified --size 320x240 --out in").code, 0);
  python(program_.folder(),
         "import numpy as np\nfrom PIL import Image\n"
         "d = np.array(Image.open('in/disp_gt.png')) / 256\n"
         "np.save('depth.npy', np.where(d > 0, 28.8 / np.maximum(d, 1e-3), 0))\n");
  const std::string line =
      said("--left in/left.png --right in/right.png --ground-truth depth.npy --ground-truth-scale 1");
  EXPECT_EQ(line.rfind("parallax: note: the ground truth looks like depth, not like disparities: both "
                       "multiplied are 28.",
                       0),
            0U)
      << line;
}

TEST_F(InputHints, TheSamePictureTwice) {
  ASSERT_EQ(program_("scene --rectified --size 64x48 --disparities 32 --out in").code, 0);
  EXPECT_EQ(
      said("-d 32 --left in/left.png --right in/left.png"),
      "parallax: note: the left image in/left.png and the right image in/left.png are the same picture\n");
}

// The scene's own calibration in KITTI's form, which has no size: of the images, and of those of twice the
// size.
TEST_F(InputHints, ACalibrationForImagesOfAnotherSize) {
  ASSERT_EQ(program_("scene --rectified --size 64x48 --disparities 32 --out in").code, 0);
  const std::string pair = "-d 32 --left in/left.png --right in/right.png --calibration calib.txt";
  program_.folder().write("calib.txt",
                          "P0: 48 0 31.5 0 0 48 23.5 0 0 0 1 0\nP1: 48 0 31.5 -6 0 48 23.5 0 0 0 1 0\n");
  EXPECT_EQ(said(pair), "");
  program_.folder().write("calib.txt",
                          "P0: 96 0 63 0 0 96 47 0 0 0 1 0\nP1: 96 0 63 -12 0 96 47 0 0 0 1 0\n");
  EXPECT_EQ(said(pair),
            "parallax: note: calib.txt: the principal point (63.0, 47.0) is far from the middle of images of "
            "64x48: is the calibration for images of another size?\n");
}

}  // namespace input_hints_test
}  // namespace parallax::test
