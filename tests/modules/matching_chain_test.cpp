// SPDX-License-Identifier: Apache-2.0
// Census to consistency on real pairs: bit for bit against the whole-image definitions, and how good it is.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "platform/images/image_codecs.hpp"
#include "tests/modules/naive_census.hpp"
#include "tests/modules/naive_consistency.hpp"
#include "tests/modules/naive_matching.hpp"
#include "tests/modules/naive_subpixel.hpp"
#include "tests/modules/naive_uniqueness.hpp"
#include "tests/modules/real_pair.hpp"

namespace parallax {
namespace matching_chain_test {

using test::ChainConfig;
using test::Grid;

Grid<Disparity> naive_chain(const ChainConfig& config, const Grid<Gray>& left, const Grid<Gray>& right) {
  const DisparityRange range = config.matching.range();
  const auto costs =
      test::naive_matching(config.matching, config.census.code_bits(),
                           test::naive_census(config.census, left), test::naive_census(config.census, right));
  auto map = test::naive_subpixel(config.subpixel, range, costs);
  map = test::naive_uniqueness(config.uniqueness, range, costs, map);
  return test::naive_consistency(config.consistency, range, costs, map);
}

struct Scene {
  cv::Mat left;
  cv::Mat right;
  cv::Mat truth;  ///< 1/256 px, 0 unknown
  cv::Mat mask;   ///< 255: visible in both views
};

/// The Aloe pair of OpenCV's documentation at 1/shrink of its size; its truth is in whole pixels of the full
/// size.
Scene load_aloe(int shrink) {
  const std::string folder = "/usr/share/doc/opencv-doc/examples/data/";
  const auto load = [&](const char* name) { return read_image(folder + name, cv::IMREAD_GRAYSCALE); };
  Scene scene{load("aloeL.jpg"), load("aloeR.jpg"), load("aloeGT.png"), {}};
  if (scene.left.empty() || scene.right.empty() || scene.truth.empty()) return {};
  const cv::Size size = scene.left.size() / shrink;
  cv::resize(scene.left, scene.left, size, 0, 0, cv::INTER_AREA);
  cv::resize(scene.right, scene.right, size, 0, 0, cv::INTER_AREA);
  cv::resize(scene.truth, scene.truth, size, 0, 0, cv::INTER_NEAREST);
  scene.truth.convertTo(scene.truth, CV_16U, 256.0 / shrink);

  // Visible where no larger disparity lands on the same right pixel or next to it.
  scene.mask = cv::Mat::zeros(size, CV_8U);
  for (int y = 0; y < size.height; ++y) {
    std::vector<int> nearest(static_cast<std::size_t>(size.width) + 2, 0);
    const auto right_x = [&](int x) { return x - (scene.truth.at<std::uint16_t>(y, x) + 128) / 256; };
    for (int x = 0; x < size.width; ++x) {
      if (right_x(x) < 0) continue;
      int& d = nearest[static_cast<std::size_t>(right_x(x)) + 1];
      d = std::max<int>(d, scene.truth.at<std::uint16_t>(y, x));
    }
    for (int x = 0; x < size.width; ++x) {
      const int d = scene.truth.at<std::uint16_t>(y, x);
      if (d == 0 || right_x(x) < 0) continue;
      const auto u = static_cast<std::size_t>(right_x(x));
      const int front = std::max({nearest[u], nearest[u + 1], nearest[u + 2]});
      if (front <= d + 256) scene.mask.at<std::uint8_t>(y, x) = 255;
    }
  }
  return scene;
}

Scene load_scene(const std::string& name) {
  if (name == "aloe_half") return load_aloe(2);
  if (name == "aloe_third") return load_aloe(3);
  return {test::load_shared(name + "/left.png"), test::load_shared(name + "/right.png"),
          test::load_shared(name + "/disp_gt.png", cv::IMREAD_UNCHANGED),
          test::load_shared(name + "/mask_nocc.png")};
}

class RealPair : public ::testing::TestWithParam<const char*> {};

TEST_P(RealPair, equals_the_definitions) {
  const Scene scene = load_scene(GetParam());
  if (scene.left.empty() || scene.right.empty()) GTEST_SKIP() << "no data";
  ChainConfig config;
  constexpr int kRows = 100;  // the definitions are slow
  const auto l = test::to_grid(scene.left.rowRange(0, kRows));
  const auto r = test::to_grid(scene.right.rowRange(0, kRows));
  EXPECT_EQ(test::run_chain(config, l, r), naive_chain(config, l, r));

  config.census.border = CensusBorder::kMask;
  config.census.comparison = CensusComparison::kLessEqual;
  config.matching.paths = kEightPaths;
  config.matching.iterations = 2;
  config.matching.disparity_offset = 3;
  config.matching.path_start = PathStart::kDelayLine;
  config.subpixel.curve = SubpixelCurve::kEquiangular;
  config.subpixel.rounding = SubpixelRounding::kNearest;
  EXPECT_EQ(test::run_chain(config, l, r), naive_chain(config, l, r));
}

TEST_P(RealPair, equals_the_definitions_as_delay_lines_have_it) {
  const Scene scene = load_scene(GetParam());
  if (scene.left.empty() || scene.right.empty()) GTEST_SKIP() << "no data";
  constexpr int kRows = 60;
  const auto l = test::to_grid(scene.left.rowRange(0, kRows));
  const auto r = test::to_grid(scene.right.rowRange(0, kRows));
  ChainConfig config;
  config.matching.iterations = 2;
  config.census.border = CensusBorder::kDelayLine;
  config.matching.outside_cost = OutsideCost::kDelayLine;
  config.matching.path_start = PathStart::kFirstColumn;
  config.matching.path_bits = 5;
  config.matching.sum_shift = 1;
  EXPECT_EQ(test::run_chain(config, l, r), naive_chain(config, l, r));

  config.census.enabled = false;
  config.matching.cost = MatchingCost::kAbsoluteDifference;
  config.matching.paths = kEightPaths;
  config.matching.path_bits = 7;
  config.matching.path_overflow = PathOverflow::kWrap;
  EXPECT_EQ(test::run_chain(config, l, r), naive_chain(config, l, r));

  config.matching.outside_cost = OutsideCost::kValue;
  config.matching.outside_value = 40;
  EXPECT_EQ(test::run_chain(config, l, r), naive_chain(config, l, r));
}

struct Score {
  double bad;       ///< percent of the valid pixels that are off by more than 2 px
  double coverage;  ///< percent of the visible pixels that are valid
};

/// `disparity(x, y)` in 1/16 px, negative if invalid.
template <class Map>
Score score(const Scene& scene, Map disparity) {
  int visible = 0;
  int valid = 0;
  int bad = 0;
  for (int y = 0; y < scene.truth.rows; ++y) {
    for (int x = 0; x < scene.truth.cols; ++x) {
      if (scene.mask.at<std::uint8_t>(y, x) != 255) continue;
      ++visible;
      const int d = disparity(x, y);
      if (d < 0) continue;
      ++valid;
      bad += std::abs(d / 16.0 - scene.truth.at<std::uint16_t>(y, x) / 256.0) > 2.0 ? 1 : 0;
    }
  }
  return {100.0 * bad / valid, 100.0 * valid / visible};
}

/// The chain alone, without the filters that follow it, against OpenCV's complete matcher (speckle filter
/// included).
TEST_P(RealPair, is_not_worse_than_opencv) {
  const Scene scene = load_scene(GetParam());
  if (scene.left.empty() || scene.truth.empty() || scene.mask.empty()) GTEST_SKIP() << "no data";
  const auto map = test::run_chain(ChainConfig{}, test::to_grid(scene.left), test::to_grid(scene.right));
  const Score ours =
      score(scene, [&](int x, int y) { return map.at(x, y).valid() ? map.at(x, y).value : -1; });

  const auto sgbm = cv::StereoSGBM::create(0, 128, 5, 8 * 25, 32 * 25, 1, 63, 10, 100, 2);
  cv::Mat theirs_map;
  sgbm->compute(scene.left, scene.right, theirs_map);
  const Score theirs = score(scene, [&](int x, int y) { return int{theirs_map.at<std::int16_t>(y, x)}; });

  RecordProperty("bad_2", std::to_string(ours.bad));
  RecordProperty("coverage", std::to_string(ours.coverage));
  EXPECT_LE(ours.bad, theirs.bad + 1.0) << "OpenCV: " << theirs.bad;
  EXPECT_GE(ours.coverage, theirs.coverage - 8.0) << "OpenCV: " << theirs.coverage;
}

INSTANTIATE_TEST_SUITE_P(matching_chain, RealPair,
                         ::testing::Values("tsukuba", "cones", "cloth3", "aloe_half", "aloe_third"));

}  // namespace matching_chain_test
}  // namespace parallax
