// SPDX-License-Identifier: Apache-2.0
// The program's own quality figures against an evaluation of its disparity.png that shares no code with it.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "platform/images/image_codecs.hpp"
#include "tests/fidelity/program.hpp"
#include "tests/paths.hpp"

namespace parallax::test {
namespace program_quality_test {

struct Figures {
  int scored = 0;
  int valid = 0;
  int bad[3] = {};
  double error = 0;  ///< px, sum
};

/// disparity.png and the ground truth: 16 bit, disparity * 256, 0 = none.
Figures figures(const cv::Mat& disparity, const cv::Mat& truth, const cv::Mat& mask) {
  Figures result;
  for (int y = 0; y < truth.rows; ++y) {
    for (int x = 0; x < truth.cols; ++x) {
      if (truth.at<ushort>(y, x) == 0 || mask.at<uchar>(y, x) != 255) continue;
      ++result.scored;
      if (disparity.at<ushort>(y, x) == 0) continue;
      ++result.valid;
      const double error = std::abs(disparity.at<ushort>(y, x) - truth.at<ushort>(y, x)) / 256.0;
      result.error += error;
      for (int limit = 1; limit <= 3; ++limit) result.bad[limit - 1] += error > limit;
    }
  }
  return result;
}

class ProgramQuality : public ::testing::TestWithParam<const char*> {};

TEST_P(ProgramQuality, FiguresEqualAnIndependentEvaluation) {
  const std::string folder = shared_data(GetParam()) + "/";
  const cv::Mat truth = read_image(folder + "disp_gt.png");
  if (truth.empty()) GTEST_SKIP() << "no stereo data here";
  const ProgramRun run("--left " + folder + "left.png --right " + folder + "right.png --ground-truth " +
                       folder + "disp_gt.png --mask " + folder + "mask_nocc.png");
  const cv::Mat disparity = run.image("disparity.png");
  ASSERT_EQ(disparity.size(), truth.size());
  ASSERT_EQ(disparity.type(), CV_16UC1);
  const Figures expected = figures(disparity, truth, read_image(folder + "mask_nocc.png"));
  constexpr double kRounding = 1e-9;
  EXPECT_EQ(run.quality("scored_pixels"), expected.scored);
  EXPECT_EQ(run.quality("valid_pixels"), expected.valid);
  EXPECT_NEAR(run.quality("coverage"), 100.0 * expected.valid / expected.scored, kRounding);
  EXPECT_NEAR(run.quality("mean_error"), expected.error / expected.valid, kRounding);
  for (int limit = 1; limit <= 3; ++limit) {
    const std::string name = "bad_" + std::to_string(limit);
    const int bad = expected.bad[limit - 1];
    EXPECT_NEAR(run.quality(name), 100.0 * bad / expected.valid, kRounding);
    EXPECT_NEAR(run.quality(name + "_all"),
                100.0 * (bad + expected.scored - expected.valid) / expected.scored, kRounding);
  }
  EXPECT_NEAR(run.quality("valid_share"), 100.0 * cv::countNonZero(disparity) / disparity.size().area(),
              kRounding);

  // A rectified pair passes the rectification stage unchanged but for the conversion to mono.
  cv::Mat difference;
  cv::absdiff(run.image("left_rectified.png"), read_image(folder + "left.png", cv::IMREAD_GRAYSCALE),
              difference);
  EXPECT_LE(cv::norm(difference, cv::NORM_INF), 1);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ProgramQuality,
                         ::testing::Values("tsukuba", "cones", "cloth3", "kitti2012_000000"));

}  // namespace program_quality_test
}  // namespace parallax::test
