// SPDX-License-Identifier: Apache-2.0
#include "modules/noise_reduction.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/modules/disparity_image.hpp"
#include "tests/modules/naive_noise_reduction.hpp"
#include "tests/modules/user_error.hpp"

namespace parallax::test {
namespace noise_reduction_test {

TEST(NoiseReduction, EqualsTheDefinition) {
  for (const auto kind : {NoiseReductionKind::kMean, NoiseReductionKind::kMedian}) {
    for (const int window : {3, 5, 7}) {
      for (const int max_difference : {0, 16, 4094}) {
        NoiseReductionConfig config;
        config.kind = kind;
        config.window = window;
        config.max_difference = max_difference;
        expect_matches_reference<NoiseReduction>(config, naive_noise_reduction);
        if (HasFatalFailure()) return;
      }
    }
  }
}

TEST(NoiseReduction, PlainMediansEqualTheDefinition) {
  for (const auto kind : {NoiseReductionKind::kMedian3x3, NoiseReductionKind::kMedian5x5}) {
    NoiseReductionConfig config;
    config.kind = kind;
    expect_matches_reference<NoiseReduction>(config, naive_noise_reduction);
    if (HasFatalFailure()) return;
  }
}

TEST(NoiseReduction, PlainMediansFillAndEmptyAndLeaveTheBorder) {
  DisparityImage image(5, 3);
  for (Disparity& pixel : image.pixels) pixel = {100, Cause::kMatched};
  image.at(1, 1) = {kInvalidDisparity, Cause::kTexture};  // three of nine around it are: filled
  image.at(0, 0) = image.at(0, 1) = {kInvalidDisparity, Cause::kBorder};
  image.at(2, 1) = {900, Cause::kMatched};
  image.at(3, 0).value = image.at(3, 2).value = image.at(4, 1).value = image.at(4, 2).value =
      image.at(4, 0).value = kInvalidDisparity;  // five around (3, 1): emptied
  NoiseReductionConfig config;
  config.kind = NoiseReductionKind::kMedian3x3;
  NoiseReduction median(config, 5, 3);
  DisparityImage expected = image;
  expected.at(1, 1) = {100, Cause::kMatched};
  expected.at(2, 1) = {100, Cause::kMatched};
  expected.at(3, 1) = {kInvalidDisparity, Cause::kNoise};
  expect_equal(filtered(median, image), expected);
}

RC_GTEST_PROP(NoiseReduction, EqualsTheDefinitionForAnyConfiguration, ()) {
  NoiseReductionConfig config;
  config.kind = *rc::gen::element(NoiseReductionKind::kMean, NoiseReductionKind::kMedian);
  config.window = *rc::gen::element(3, 5, 7);
  config.max_difference = *rc::gen::element(0, 1, 8, 16, 100, 4094);
  const int width = *rc::gen::inRange(1, 40);
  const int height = *rc::gen::inRange(1, 40);
  const auto content = *rc::gen::elementOf(kContents);
  const DisparityImage input = random_disparities(width, height, *rc::gen::arbitrary<unsigned>(), content);
  NoiseReduction reduction(config, width, height);
  RC_ASSERT(filtered(reduction, input).pixels == naive_noise_reduction(config, input).pixels);
}

TEST(NoiseReduction, LargestImage) {
  const DisparityImage input = random_disparities(1856, 1856, 6, Content::kPatches);
  NoiseReduction reduction({}, 1856, 1856);
  expect_equal(filtered(reduction, input), naive_noise_reduction({}, input));
}

TEST(NoiseReduction, DividesExactlyByEachCount) {
  // The stored reciprocal against the quotient, for the largest sums and around each multiple of the divisor.
  for (std::uint64_t n = 1; n <= 49; ++n) {
    const std::uint64_t reciprocal = (std::uint64_t{1} << 32) / (2 * n) + 1;
    for (std::uint64_t v = 0; v <= 2 * n * 4094 + n; ++v) {
      ASSERT_EQ((v * reciprocal) >> 32, v / (2 * n)) << v << " / " << 2 * n;
    }
  }
}

TEST(NoiseReduction, KeepsADiscontinuityAndInvalidPixels) {
  DisparityImage image(12, 6);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 12; ++x)
      image.at(x, y) = {static_cast<std::uint16_t>(x < 6 ? 100 : 117), Cause::kMatched};
  }
  image.at(3, 3) = {kInvalidDisparity, Cause::kUniqueness};
  image.at(8, 3).cause = Cause::kInterpolated;
  for (const auto kind : {NoiseReductionKind::kMean, NoiseReductionKind::kMedian}) {
    NoiseReductionConfig config;
    config.kind = kind;
    config.max_difference = 16;
    NoiseReduction reduction(config, 12, 6);
    expect_equal(filtered(reduction, image), image);
  }
}

TEST(NoiseReduction, SmoothsWithinTheDifference) {
  DisparityImage image(3, 1);
  image.pixels = {{100, Cause::kMatched}, {102, Cause::kMatched}, {103, Cause::kMatched}};
  NoiseReductionConfig config;
  NoiseReduction mean(config, 3, 1);
  EXPECT_EQ(filtered(mean, image).at(0, 0).value, 101);
  EXPECT_EQ(filtered(mean, image).at(1, 0).value, 102);  // 101.67
  EXPECT_EQ(filtered(mean, image).at(2, 0).value, 103);  // 102.5, half up
  config.kind = NoiseReductionKind::kMedian;
  NoiseReduction median(config, 3, 1);
  EXPECT_EQ(filtered(median, image).at(0, 0).value, 100);  // the lower one of two
  EXPECT_EQ(filtered(median, image).at(1, 0).value, 102);
}

TEST(NoiseReduction, DisabledPassesTheInputAtOnce) {
  NoiseReductionConfig config;
  config.enabled = false;
  NoiseReduction reduction(config, 30, 20);
  EXPECT_EQ(reduction.look_ahead_rows(), 0);
  EXPECT_EQ(reduction.look_ahead_pixels(), 0);
  EXPECT_EQ(reduction.storage_bits(), 0);
  const DisparityImage input = random_disparities(30, 20, 1, Content::kPatches);
  expect_equal(filtered(reduction, input), input);
}

TEST(NoiseReduction, DeclaresWhatItsCircuitNeeds) {
  NoiseReductionConfig config;
  config.window = 3;
  const NoiseReduction reduction(config, 640, 480);
  EXPECT_EQ(reduction.look_ahead_rows(), 1);
  EXPECT_EQ(reduction.look_ahead_pixels(), 1);
  EXPECT_EQ(reduction.storage_bits(), (2 * 640 + 9) * 12);
  config.kind = NoiseReductionKind::kMedian5x5;
  const NoiseReduction median(config, 640, 480);
  EXPECT_EQ(median.look_ahead_rows(), 2);
  EXPECT_EQ(median.look_ahead_pixels(), 2);
  EXPECT_EQ(median.storage_bits(), (4 * 640 + 25) * 12);
  config.kind = NoiseReductionKind::kMedian3x3;
  EXPECT_EQ(NoiseReduction(config, 640, 480).storage_bits(), (2 * 640 + 9) * 12);
}

TEST(NoiseReduction, SaysWhatIsWrongWithItsConfiguration) {
  NoiseReductionConfig config;
  EXPECT_EQ(complaint(config), "");
  config.window = 9;
  EXPECT_EQ(complaint(config), "noise_reduction.window = 9: must be odd and within 3..7");
  EXPECT_THROW(NoiseReduction(config, 8, 8), UserError);
  config = {};
  config.max_difference = 5000;
  EXPECT_EQ(complaint(config), "noise_reduction.max_difference = 5000: must be within 0..4094");
  config = {};
  config.kind = NoiseReductionKind::kMedian3x3;
  EXPECT_EQ(complaint(config), "");
  config.window = 5;
  EXPECT_EQ(complaint(config),
            "noise_reduction.window = 5: has no effect with noise_reduction.kind = \"median_3x3\"");
  config = {};
  config.kind = NoiseReductionKind::kMedian5x5;
  config.max_difference = 16;
  EXPECT_EQ(complaint(config),
            "noise_reduction.max_difference = 16: has no effect with noise_reduction.kind = \"median_5x5\"");
}

}  // namespace noise_reduction_test
}  // namespace parallax::test
