// SPDX-License-Identifier: Apache-2.0
#include "platform/input/middlebury_calibration.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "platform/input/read_calibration.hpp"
#include "tests/platform/test_calibrations.hpp"

namespace parallax {
namespace middlebury_calibration_test {

using test::message;

constexpr const char* kText =
    "cam0=[1000 0 311.5; 0 1000 254.25; 0 0 1]\n"
    "cam1=[1000 0 342.75; 0 1000 254.25; 0 0 1]\n"
    "doffs=31.25\n"
    "baseline=200\n"
    "width=720\nheight=496\nndisp=70\nisint=0\nvmin=5\nvmax=60\ndyavg=0\ndymax=0\n";

class MiddleburyCalibration : public test::FolderTest {
 protected:
  Calibration read(const std::string& text) const { return read_calibration({write("calib.txt", text)}); }
  // The line for a file in which something has been replaced, without its name.
  std::string changed(const std::string& what, const std::string& with) const {
    std::string text = kText;
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    const std::string whole = message([&] { read(text.replace(at, what.size(), with)); });
    const std::string prefix = path("calib.txt") + ": ";
    EXPECT_TRUE(whole.empty() || whole.find(prefix) == 0) << whole;
    return whole.empty() ? whole : whole.substr(prefix.size());
  }
};

TEST_F(MiddleburyCalibration, DepthIsBaselineTimesFocalLengthOverDisparityAndOffset) {
  const Calibration c = read(kText);
  EXPECT_EQ(c.model, LensModel::kRectified);
  EXPECT_EQ(c.unit, "mm");
  EXPECT_EQ(c.size.width, 720);
  EXPECT_EQ(c.size.height, 496);
  EXPECT_DOUBLE_EQ(c.geometry->baseline, 200);
  EXPECT_DOUBLE_EQ(c.geometry->doffs(), 31.25);
  // At d = 8.75 px: 200 * 1000 / (8.75 + 31.25) = 5000 mm; pixel (411.5, 254.25): X = 100 / 1000 * 5000 = 500
  // mm.
  const cv::Vec4d h = disparity_to_depth(*c.geometry) * cv::Vec4d(411.5, 254.25, 8.75, 1);
  EXPECT_NEAR(h[0] / h[3], 500, 1e-9);
  EXPECT_NEAR(h[1] / h[3], 0, 1e-9);
  EXPECT_NEAR(h[2] / h[3], 5000, 1e-9);
}

TEST_F(MiddleburyCalibration, WaysToWriteIt) {
  EXPECT_EQ(changed("width=720\nheight=496\nndisp=70\nisint=0\nvmin=5\nvmax=60\ndyavg=0\ndymax=0\n",
                    "width = 720\r\nheight= 496\r\n"),
            "");
  EXPECT_EQ(changed("[1000 0 311.5; 0 1000 254.25; 0 0 1]", "[1.0e+03 0 311.5;0 1000. 254.25;0,0,1]\r"), "");
  EXPECT_EQ(changed("doffs=31.25\n", ""), "") << "it follows from cam0 and cam1";
}

TEST_F(MiddleburyCalibration, DamageIsNamed) {
  EXPECT_EQ(changed("cam0", "cam9"), "cam0 is missing");
  EXPECT_EQ(changed("cam1", "cam9"), "cam1 is missing");
  EXPECT_EQ(changed("baseline=200\n", ""), "baseline is missing");
  EXPECT_EQ(changed("height=496\n", ""), "height is missing");
  EXPECT_EQ(changed("width=720\n", "width=wide\n"), "width: \"wide\" is not a number");
  EXPECT_EQ(changed("width=720", "width=-720"), "width, height: -720x496 is not an image size");
  EXPECT_EQ(changed("doffs=31.25", "doffs=0"),
            "doffs: 0, but the principal points of cam1 and cam0 are 31.25 px apart");
  EXPECT_EQ(changed("doffs=31.25", "doffs=31.2"), "");
  EXPECT_EQ(changed("baseline=200", "baseline=nan"), "baseline holds a value that is not a finite number");
  EXPECT_EQ(changed("baseline=200", "baseline=0"), "baseline: the baseline is zero");
  EXPECT_EQ(changed("baseline=200", "baseline=-200"),
            "baseline: the right camera lies 200 to the left of the left one; are the images exchanged?");
  EXPECT_EQ(changed("0 0 1]", "0 1]"), "cam0 has 8 numbers, 9 expected");
  EXPECT_EQ(changed("[1000 0", "[-1000 0"),
            "cam0: not a camera matrix: focal lengths -1000 and 1000 px, last element 1");
  EXPECT_EQ(changed("cam1=[1000 0", "cam1=[1100 0"),
            "baseline: horizontal focal lengths 1000 px left and 1100 px right; rectified images have one");
}

TEST_F(MiddleburyCalibration, TheImagesMustHaveItsSize) {
  const Calibration c = read(kText);
  EXPECT_EQ(message([&] {
              check_size(c, {360, 248});
            }),
            path("calib.txt") + ": the calibration is for images of 720x496, these have 360x248");
}

}  // namespace middlebury_calibration_test
}  // namespace parallax
