// SPDX-License-Identifier: Apache-2.0
#include "platform/results/truth_scale.hpp"

#include <gtest/gtest.h>

namespace parallax {
namespace truth_scale_test {

/// 20 x 20 disparities from 4 px upwards, and the truth that a file of them times `stored` holds when it is
/// read with the scale `assumed`.
struct Scaled {
  std::vector<Disparity> found;
  GroundTruth truth;
};

Scaled scaled(double stored, double assumed) {
  Scaled result;
  result.truth = {20, 20, {}, {}, assumed};
  for (int i = 0; i < 400; ++i) {
    const int sixteenths = 64 + (i * 37) % 700;
    result.found.push_back({static_cast<std::uint16_t>(sixteenths), Cause::kMatched});
    result.truth.disparity.push_back(static_cast<float>(sixteenths / 16.0 * stored / assumed));
  }
  return result;
}

TEST(TruthScale, AScaleThatWouldFitIsNamed) {
  for (const double stored : {1., 2., 3., 4., 8., 16., 100., 256., 1000.}) {
    for (const double assumed : {1., 4., 16., 256.}) {
      const Scaled scene = scaled(stored, assumed);
      const auto better = better_truth_scale(scene.found, scene.truth);
      if (stored == assumed) {
        EXPECT_FALSE(better) << stored;
      } else {
        ASSERT_TRUE(better) << stored << " as " << assumed;
        EXPECT_DOUBLE_EQ(*better, stored);
      }
    }
  }
  const Scaled odd = scaled(7.3, 256);
  EXPECT_NEAR(better_truth_scale(odd.found, odd.truth).value_or(0), 7.3, 1e-3);
  const Scaled scene = scaled(16, 256);
  EXPECT_EQ(truth_scale_notice(scene.found, scene.truth),
            "the ground truth looks like one of another scale: nearly all of it is off by one factor, and "
            "--ground-truth-scale 16 instead of 256 would fit");
}

TEST(TruthScale, NothingIsSaidOfATruthThatFitsOrOfNone) {
  Scaled noisy = scaled(256, 256);
  for (std::size_t i = 0; i < 250; ++i) noisy.found[i].value = static_cast<std::uint16_t>(16 * (i % 90) + 8);
  EXPECT_EQ(truth_scale_notice(noisy.found, noisy.truth), "") << "many are wrong, but by no one factor";
  Scaled random = scaled(256, 256);
  for (std::size_t i = 0; i < 400; ++i)
    random.found[i].value = static_cast<std::uint16_t>((i * 7919) % 1900 + 16);
  EXPECT_EQ(truth_scale_notice(random.found, random.truth), "") << "all is wrong";
  Scaled few = scaled(16, 256);
  for (std::size_t i = 50; i < 400; ++i) few.found[i].value = kInvalidDisparity;
  EXPECT_EQ(truth_scale_notice(few.found, few.truth), "") << "too few to say";
}

TEST(TruthScale, DepthInThePlaceOfDisparityIsSaidToBe) {
  Scaled scene = scaled(1, 1);
  for (float& value : scene.truth.disparity) value = 86.4F / value;  // 720 px * 0.12 m
  EXPECT_EQ(truth_scale_notice(scene.found, scene.truth),
            "the ground truth looks like depth, not like disparities: both multiplied are 86.4 nearly "
            "everywhere, and disparity = 86.4 / depth");
}

}  // namespace truth_scale_test
}  // namespace parallax
