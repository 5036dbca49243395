// SPDX-License-Identifier: Apache-2.0
#include "platform/input/map_builder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "modules/map_codec.hpp"
#include "modules/rectification.hpp"
#include "platform/images/image_codecs.hpp"
#include "platform/input/map_fit.hpp"
#include "platform/input/read_calibration.hpp"
#include "tests/paths.hpp"
#include "tests/platform/test_calibrations.hpp"

namespace parallax {
namespace map_builder_test {

using test::message;
using test::SyntheticPair;

class MapBuilder : public test::FolderTest {
 protected:
  Calibration calibration(const SyntheticPair& pair) const {
    return read_calibration({write("c.yml", pair.text())});
  }
};

// Coordinates where the only rounding is the map's own.
RawMaps plain_maps(int width, int height, float shift) {
  RawMaps maps;
  maps.left_x.create(height, width, CV_32FC1);
  maps.left_y.create(height, width, CV_32FC1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      maps.left_x.at<float>(y, x) = static_cast<float>(x) + shift;
      maps.left_y.at<float>(y, x) = static_cast<float>(y) - shift;
    }
  }
  maps.right_x = maps.left_x.clone();
  maps.right_y = maps.left_y.clone();
  return maps;
}

void rectify(const RectificationMap& map, const cv::Mat& left, const cv::Mat& right, cv::Mat& out_left,
             cv::Mat& out_right) {
  RectificationConfig config;
  config.range = map.range;
  Rectification kernel(config, map.width, map.height);
  out_left.create(left.size(), CV_8UC1);
  out_right.create(left.size(), CV_8UC1);
  int row = 0;
  const Rectification::Emit emit = [&](const Gray* l, const Gray* r) {
    std::copy_n(l, map.width, out_left.ptr(row));
    std::copy_n(r, map.width, out_right.ptr(row++));
  };
  for (int y = 0; y < map.height; ++y) {
    kernel.push_map(map.row(y), emit);
    kernel.push_images(left.ptr(y), right.ptr(y), emit);
  }
}

void expect_as_remap(const Calibration& c, const cv::Mat& left, const cv::Mat& right) {
  const RawMaps maps = raw_maps(c);
  cv::Mat out_left;
  cv::Mat out_right;
  rectify(build_map(c, {}), left, right, out_left, out_right);
  cv::Mat expected_left;
  cv::Mat expected_right;
  cv::remap(left, expected_left, maps.left_x, maps.left_y, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::remap(right, expected_right, maps.right_x, maps.right_y, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  EXPECT_LE(cv::norm(out_left, expected_left, cv::NORM_INF), 1);
  EXPECT_LE(cv::norm(out_right, expected_right, cv::NORM_INF), 1);
}

TEST(Quantise, RoundsHalfToEven) {
  const OffsetRange range;
  EXPECT_EQ(quantise(plain_maps(3, 3, 0.5F / 32), range).row(1)[1].left.dx, 0);
  EXPECT_EQ(quantise(plain_maps(3, 3, 1.5F / 32), range).row(1)[1].left.dx, 2);
  EXPECT_EQ(quantise(plain_maps(3, 3, 2.5F / 32), range).row(1)[1].right.dx, 2);
  EXPECT_EQ(quantise(plain_maps(3, 3, 2.5F / 32), range).row(1)[1].right.dy, -2);
  EXPECT_EQ(quantise(plain_maps(3, 3, 39), range).row(2)[0].left.dx, 39 * 32);
  EXPECT_EQ(quantise(plain_maps(3, 3, 2.5F), {79, 0}).row(1)[0].left.dx, 2);
  EXPECT_EQ(quantise(plain_maps(3, 3, 2.5F), {79, 8}).row(1)[0].left.dx, 640);
}

TEST(Quantise, MapsThatItGivesBackAreTheSame) {
  const RawMaps maps = plain_maps(40, 30, 7.3F);
  for (int fraction_bits = 0; fraction_bits <= 8; ++fraction_bits) {
    const OffsetRange range{79, fraction_bits};
    const RectificationMap map = quantise(maps, range);
    EXPECT_TRUE(quantise(raw_maps(map), range).offsets == map.offsets);
  }
}

TEST(Window, IsNotExceededAtItsEdgeAndIsBeyond) {
  EXPECT_TRUE(survey(plain_maps(5, 4, 39), {}).fits());
  const RawMaps beyond = plain_maps(5, 4, 39.25F);
  const WindowSurvey found = survey(beyond, {});
  EXPECT_EQ(found.left.beyond, 20U);
  EXPECT_EQ(found.window_needed, 81);
  EXPECT_EQ(message([&] { build_map(beyond, {}, "maps.yml"); }),
            "maps.yml: left image: pixel (0, 0) needs the offset (+39.25, -39.25) px, beyond the window of "
            "79 (-39..+39 "
            "px); 20 of 20 pixels are affected in the left image, 20 in the right; a window of 81 would do "
            "(line storage "
            "of both images 6 instead of 6 kbit), or maps of another zoom or shift");
  EXPECT_NO_THROW(build_map(beyond, {81, 5}, "maps.yml"));
  EXPECT_THROW(quantise(beyond, {}), std::invalid_argument);
}

TEST(Window, APixelWithoutSourceFitsInNone) {
  RawMaps maps = plain_maps(5, 4, 0);
  maps.right_x.at<float>(2, 3) = std::numeric_limits<float>::quiet_NaN();
  maps.right_y.at<float>(3, 1) = std::numeric_limits<float>::infinity();
  const std::string line = message([&] { build_map(maps, {}, "maps.yml"); });
  EXPECT_EQ(line.find("maps.yml: right image: pixel (3, 2) needs the offset ("), 0U) << line;
  EXPECT_NE(line.find("0 of 20 pixels are affected in the left image, 2 in the right; no window would do"),
            std::string::npos)
      << line;
}

TEST_F(MapBuilder, BandsGiveTheMapsOfTheWholeImage) {
  std::vector<SyntheticPair> pairs(3);
  pairs[1].distortion = {-0.05, 0.02, 0.001, -0.001, 0.001};
  pairs[2] = test::fisheye_pair();
  const OffsetRange range{511, 5};
  for (const SyntheticPair& pair : pairs) {
    const Calibration c = calibration(pair);
    const RectificationMap whole = quantise(raw_maps(c), range);
    ASSERT_GT(whole.height, 2 * 64) << "several bands";
    EXPECT_TRUE(build_map(c, range).offsets == whole.offsets) << pair.text();
    WindowSurvey banded;
    int rows = 0;
    for_each_band(c, [&](const RawMaps& band) {
      EXPECT_EQ(band.first_row, rows);
      rows += band.left_x.rows;
      banded.add(band, {});
    });
    EXPECT_EQ(rows, whole.height);
    const WindowSurvey all = survey(raw_maps(c), {});
    EXPECT_EQ(banded.window_needed, all.window_needed);
    EXPECT_EQ(banded.left.beyond, all.left.beyond);
    EXPECT_EQ(banded.right.beyond, all.right.beyond);
    EXPECT_EQ(banded.right.y, all.right.y);
    EXPECT_EQ(banded.pixels, all.pixels);
  }
}

TEST_F(MapBuilder, TheWindowThatTheMessageNamesIsTheSmallest) {
  SyntheticPair pair;
  pair.distortion = {-0.4, 0.1, 0, 0, 0};
  pair.focal = 400;
  const Calibration c = calibration(pair);
  const int needed = survey(raw_maps(c), {}).window_needed;
  ASSERT_GT(needed, 79);
  EXPECT_NO_THROW(build_map(c, {needed, 5}));
  const std::string line = message([&] { build_map(c, {needed - 2, 5}); });
  EXPECT_NE(line.find("a window of " + std::to_string(needed) + " would do"), std::string::npos) << line;
}

TEST_F(MapBuilder, FitsEveryLensOfTheTestsIntoTheWindow) {
  std::vector<SyntheticPair> pairs(5);
  pairs[0].distortion = {-0.35, 0.1, 0.001, -0.001};
  pairs[1].distortion = {-0.4, 0.2, 0.001, -0.001, -0.05};
  pairs[2].distortion = {0.6, -0.1, 0.0001, 0.0002, 0.01, 0.95, 0.05, 0.001};
  pairs[3] = test::fisheye_pair();
  pairs[4].width = 1856;
  pairs[4].height = 1856;
  pairs[4].focal = 2200;
  pairs[4].distortion = {-0.15, 0.05, 0.0005, 0.0003};
  for (const SyntheticPair& pair : pairs) {
    const Calibration c = calibration(pair);
    const std::optional<Fit> found = fit(c, {});
    ASSERT_TRUE(found) << pair.text();
    EXPECT_TRUE(found->common_shift());
    EXPECT_TRUE(survey(raw_maps(found->calibration), {}).fits());
    // One focal length, rows aligned, the same baseline.
    EXPECT_DOUBLE_EQ(found->calibration.P1(0, 0), found->calibration.P2(0, 0));
    EXPECT_DOUBLE_EQ(found->calibration.P1(1, 2), found->calibration.P2(1, 2));
    EXPECT_DOUBLE_EQ(found->calibration.P1(0, 2), found->calibration.P2(0, 2));
    EXPECT_NEAR(found->calibration.geometry->baseline, c.geometry->baseline, 1e-9);
    const RectificationMap map = build_map(found->calibration, {});
    const EncodedMap encoded = encode(map);
    EXPECT_LE(encoded.bytes_per_pixel(), 1.0);
    EXPECT_TRUE(decode(encoded).offsets == map.offsets);
  }
}

TEST_F(MapBuilder, FitLeavesAloneWhatFits) {
  SyntheticPair pair;
  pair.distortion = {-0.02, 0, 0, 0};
  const Calibration c = calibration(pair);
  ASSERT_TRUE(survey(raw_maps(c), {}).fits());
  const std::optional<Fit> found = fit(c, {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->zoom, 1);
  EXPECT_EQ(found->shift_left_x, 0);
  EXPECT_EQ(found->shift_y, 0);
  EXPECT_EQ(cv::norm(found->calibration.P1 - c.P1), 0);
}

TEST_F(MapBuilder, FitMovesTheImagesApartOnlyWhenNothingElseFits) {
  // Ideal lenses whose principal points differ by 100 px: alike they need 50 px each.
  Calibration c = calibration({});
  c.left.distortion = {0, 0, 0, 0};
  c.right.distortion = {0, 0, 0, 0};
  c.left.camera = {500, 0, 320, 0, 500, 240, 0, 0, 1};
  c.right.camera = {500, 0, 420, 0, 500, 240, 0, 0, 1};
  c.R1 = cv::Matx33d::eye();
  c.R2 = cv::Matx33d::eye();
  c.P1 = {500, 0, 320, 0, 0, 500, 240, 0, 0, 0, 1, 0};
  c.P2 = {500, 0, 320, -50, 0, 500, 240, 0, 0, 0, 1, 0};
  const std::optional<Fit> found = fit(c, {});
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->common_shift());
  EXPECT_EQ(found->zoom, 1);
  EXPECT_NEAR(found->shift_right_x - found->shift_left_x, 61, 0.2);
  EXPECT_NE(found->text().find("px to every disparity"), std::string::npos) << found->text();
  // A point at 10 units: its depth comes out of the new Q.
  const double disparity = 500 * 0.1 / 10 + found->shift_left_x - found->shift_right_x;
  const cv::Vec4d point = disparity_to_depth(*found->calibration.geometry) * cv::Vec4d(0, 0, disparity, 1);
  EXPECT_NEAR(point[2] / point[3], 10, 1e-6);
}

TEST_F(MapBuilder, SaysWhichWindowAZoomNeedsWhenNothingFits) {
  // A lens so wide that a pinhole image of it bends by more than the window whatever the zoom.
  SyntheticPair pair = test::fisheye_pair();
  pair.width = 640;
  pair.height = 480;
  pair.focal = 280;
  const Calibration c = calibration(pair);
  ASSERT_FALSE(fit(c, {}));
  const int window = smallest_window(c, {});
  ASSERT_GT(window, 79);
  EXPECT_LT(window, survey(raw_maps(c), {}).window_needed);
  EXPECT_FALSE(fit(c, {window - 4, 5}));
  const std::optional<Fit> found = fit(c, {window, 5});
  ASSERT_TRUE(found);
  EXPECT_TRUE(survey(raw_maps(found->calibration), {window, 5}).fits());
  const std::string line = message([&] { build_map(c, {}); });
  EXPECT_NE(line.find("; no zoom of 0.25..4 and shift fits into this one, but --fit with a window of " +
                      std::to_string(window) + ": zoom "),
            std::string::npos)
      << line;
  EXPECT_EQ(line.find('\n'), std::string::npos);
}

TEST_F(MapBuilder, SaysWhenNothingFitsAtAll) {
  Calibration c = calibration(test::fisheye_pair());
  // Turned away by 120 degrees: the rectified image looks behind the camera.
  c.R1 = {-0.5, 0, 0.866, 0, 1, 0, -0.866, 0, -0.5};
  EXPECT_FALSE(fit(c, {}));
  EXPECT_EQ(smallest_window(c, {}), 0);
  const std::string line = message([&] { build_map(c, {}); });
  EXPECT_NE(line.find("no window would do; no zoom of 0.25..4 and shift fits into this one"),
            std::string::npos)
      << line;
  EXPECT_EQ(line.find("--fit"), std::string::npos);
}

TEST_F(MapBuilder, ARectifiedPairHasTheIdentityMap) {
  Calibration c = calibration({});
  c.model = LensModel::kRectified;
  EXPECT_TRUE(build_map(c, {}).offsets == identity_map(640, 480).offsets);
  EXPECT_EQ(fit(c, {})->zoom, 1);
}

TEST_F(MapBuilder, RectifiesLikeRemapWithSyntheticLenses) {
  cv::Mat left(480, 640, CV_8UC1);
  cv::Mat right(480, 640, CV_8UC1);
  cv::RNG random(1);
  random.fill(left, cv::RNG::UNIFORM, 0, 256);
  random.fill(right, cv::RNG::UNIFORM, 0, 256);
  for (const SyntheticPair& pair : {SyntheticPair{}, test::fisheye_pair()}) {
    const std::optional<Fit> found = fit(calibration(pair), {});
    ASSERT_TRUE(found);
    expect_as_remap(found->calibration, left, right);
  }
}

class RealCalibration : public ::testing::TestWithParam<const char*> {};

TEST_P(RealCalibration, EncodesBelowOneByteAndRectifiesLikeRemap) {
  const std::string folder = test::shared_data(GetParam());
  if (!std::filesystem::exists(folder)) {
    GTEST_SKIP() << "no shared data";
  }
  const bool sequence = std::filesystem::exists(folder + "/left_00.png");
  const cv::Mat left = read_image(folder + (sequence ? "/left_00.png" : "/left.png"), cv::IMREAD_GRAYSCALE);
  const cv::Mat right =
      read_image(folder + (sequence ? "/right_00.png" : "/right.png"), cv::IMREAD_GRAYSCALE);
  const Calibration original = read_calibration({folder + "/calib.yml"});
  check_size(original, {left.cols, left.rows});
  for (int fraction_bits = 0; fraction_bits <= 8; ++fraction_bits) {
    const OffsetRange range{79, fraction_bits};
    const std::optional<Fit> found = fit(original, range);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->common_shift());
    const RectificationMap map = build_map(found->calibration, range);
    const EncodedMap encoded = encode(map);
    EXPECT_LE(encoded.bytes_per_pixel(), 1.0) << fraction_bits << " fraction bits";
    EXPECT_TRUE(decode(encoded).offsets == map.offsets);
  }
  expect_as_remap(fit(original, {})->calibration, left, right);
}

INSTANTIATE_TEST_SUITE_P(SharedData, RealCalibration,
                         ::testing::Values("euroc_v101", "opencv_chessboard01", "kitti_seq2"),
                         [](const auto& scene) { return std::string(scene.param); });

TEST(RealCalibrationDefault, TheEurocRectificationIsBeyondTheWindow) {
  const std::string file = test::shared_data("euroc_v101/calib.yml");
  if (!std::filesystem::exists(file)) {
    GTEST_SKIP() << "no shared data";
  }
  const std::string line = message([&] { build_map(read_calibration({file}), {}); });
  EXPECT_NE(line.find("left image: pixel (0, 0) needs the offset ("), std::string::npos) << line;
  EXPECT_NE(line.find("a window of 155 would do"), std::string::npos) << line;
  EXPECT_NE(line.find("or --fit: zoom 0.85"), std::string::npos) << line;
}

}  // namespace map_builder_test
}  // namespace parallax
