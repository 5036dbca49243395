// SPDX-License-Identifier: Apache-2.0
#include "modules/gap_interpolation.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/modules/disparity_image.hpp"
#include "tests/modules/naive_gap_interpolation.hpp"
#include "tests/modules/user_error.hpp"

namespace parallax::test {
namespace gap_interpolation_test {

constexpr Disparity kGap = {kInvalidDisparity, Cause::kConsistency};
constexpr Disparity kMasked = {kInvalidDisparity, Cause::kBorder};

Disparity matched(int value) { return {static_cast<std::uint16_t>(value), Cause::kMatched}; }
Disparity interpolated(int value) { return {static_cast<std::uint16_t>(value), Cause::kInterpolated}; }

/// A one-row image.
DisparityImage row_of(const std::vector<Disparity>& pixels) {
  DisparityImage image(static_cast<int>(pixels.size()), 1);
  image.pixels = pixels;
  return image;
}

std::vector<Disparity> bridged(const GapInterpolationConfig& config, const DisparityImage& input) {
  GapInterpolation interpolation(config, input.width, input.height);
  return filtered(interpolation, input).pixels;
}

TEST(GapInterpolation, EqualsTheDefinition) {
  for (const auto rounding : {InterpolationRounding::kNearest, InterpolationRounding::kTruncate}) {
    for (const int l_max : {0, 1, 2, 5, 17, 64}) {
      for (const int max_difference : {0, 16, 200, 4094}) {
        GapInterpolationConfig config;
        config.l_max = l_max;
        config.max_difference = max_difference;
        config.rounding = rounding;
        expect_matches_reference<GapInterpolation>(config, naive_gap_interpolation);
        if (HasFatalFailure()) return;
      }
    }
  }
}

RC_GTEST_PROP(GapInterpolation, EqualsTheDefinitionForAnyConfiguration, ()) {
  GapInterpolationConfig config;
  config.l_max = *rc::gen::inRange(0, 65);
  config.max_difference = *rc::gen::element(0, 1, 8, 16, 100, 4094);
  config.rounding = *rc::gen::element(InterpolationRounding::kNearest, InterpolationRounding::kTruncate);
  const int width = *rc::gen::inRange(1, 60);
  const int height = *rc::gen::inRange(1, 60);
  const auto content = *rc::gen::elementOf(kContents);
  const DisparityImage input = random_disparities(width, height, *rc::gen::arbitrary<unsigned>(), content);
  GapInterpolation interpolation(config, width, height);
  RC_ASSERT(filtered(interpolation, input).pixels == naive_gap_interpolation(config, input).pixels);
}

TEST(GapInterpolation, LargestImage) {
  const DisparityImage input = random_disparities(1856, 1856, 6, Content::kPatches);
  GapInterpolation interpolation({}, 1856, 1856);
  expect_equal(filtered(interpolation, input), naive_gap_interpolation({}, input));
}

TEST(GapInterpolation, RoundsOrTruncates) {
  GapInterpolationConfig config;
  const DisparityImage input = row_of({matched(100), kGap, kGap, kGap, matched(110)});  // 102.5, 105, 107.5
  EXPECT_EQ(bridged(config, input),
            (std::vector<Disparity>{matched(100), interpolated(103), interpolated(105), interpolated(108),
                                    matched(110)}));
  config.rounding = InterpolationRounding::kTruncate;
  EXPECT_EQ(bridged(config, input),
            (std::vector<Disparity>{matched(100), interpolated(102), interpolated(105), interpolated(107),
                                    matched(110)}));
}

TEST(GapInterpolation, FillsUpToTheLongestGapAndSimilarEdgesOnly) {
  GapInterpolationConfig config;
  config.l_max = 2;
  config.max_difference = 16;
  const auto fills = [&](int length, int last) {
    std::vector<Disparity> pixels(static_cast<std::size_t>(length), kGap);
    pixels.insert(pixels.begin(), matched(100));
    pixels.push_back(matched(last));
    return bridged(config, row_of(pixels))[1].valid();
  };
  EXPECT_TRUE(fills(2, 116));
  EXPECT_FALSE(fills(3, 116));
  EXPECT_TRUE(fills(2, 84));
  EXPECT_FALSE(fills(2, 117));
  EXPECT_FALSE(fills(2, 83));
}

TEST(GapInterpolation, AnImageEdgeOrAMaskedPixelIsNoEdgeOfAGap) {
  for (const DisparityImage& input :
       {row_of({kGap, kGap, matched(100)}), row_of({matched(100), kGap}),
        row_of({kMasked, kGap, matched(100)}), row_of({matched(100), kMasked, matched(100)}),
        row_of({matched(100), kGap, kMasked, kGap, matched(100)})}) {
    EXPECT_EQ(bridged({}, input), input.pixels);
  }
}

TEST(GapInterpolation, TakesTheShorterWayAndTheOtherOneWhereItsEdgesAreNotSimilar) {
  // A gap 2 wide and 3 high between 100 on the left, 104 on the right, 200 above and 208 below.
  DisparityImage image(4, 5);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 4; ++x) {
      const bool inner = x >= 1 && x <= 2;
      image.at(x, y) = inner ? kGap : matched(x == 0 ? 100 : 104);
      if (inner && y == 0) image.at(x, y) = matched(200);
      if (inner && y == 4) image.at(x, y) = matched(208);
    }
  }
  GapInterpolationConfig config;
  GapInterpolation interpolation(config, 4, 5);
  EXPECT_EQ(filtered(interpolation, image).at(1, 2), interpolated(101));
  image.at(3, 2) = matched(150);
  EXPECT_EQ(filtered(interpolation, image).at(1, 2), interpolated(204));
  EXPECT_EQ(filtered(interpolation, image).at(1, 1), interpolated(101));
}

TEST(GapInterpolation, TakesTheHorizontalWayWhenBothAreEquallyLong) {
  DisparityImage image(3, 3);
  for (Disparity& d : image.pixels) d = matched(50);
  image.at(0, 1) = image.at(2, 1) = matched(100);
  image.at(1, 1) = kGap;
  GapInterpolation interpolation({}, 3, 3);
  EXPECT_EQ(filtered(interpolation, image).at(1, 1), interpolated(100));
}

TEST(GapInterpolation, DisabledPassesTheInputAtOnce) {
  GapInterpolationConfig config;
  config.enabled = false;
  GapInterpolation interpolation(config, 30, 20);
  EXPECT_EQ(interpolation.look_ahead_rows(), 0);
  EXPECT_EQ(interpolation.look_ahead_pixels(), 0);
  EXPECT_EQ(interpolation.storage_bits(), 0);
  const DisparityImage input = random_disparities(30, 20, 1, Content::kPatches);
  expect_equal(filtered(interpolation, input), input);
}

TEST(GapInterpolation, DeclaresWhatItsCircuitNeeds) {
  GapInterpolationConfig config;
  config.l_max = 5;
  const GapInterpolation interpolation(config, 640, 480);
  EXPECT_EQ(interpolation.look_ahead_rows(), 5);
  EXPECT_EQ(interpolation.look_ahead_pixels(), 0);
  EXPECT_EQ(interpolation.storage_bits(), 5 * 640 * 13 + 640 * (12 + 3) + 6 * 13);
}

TEST(GapInterpolation, SaysWhatIsWrongWithItsConfiguration) {
  GapInterpolationConfig config;
  EXPECT_EQ(complaint(config), "");
  config.l_max = 65;
  EXPECT_EQ(complaint(config), "gap_interpolation.l_max = 65: must be within 0..64");
  config.l_max = -1;
  EXPECT_THROW(GapInterpolation(config, 8, 8), UserError);
  config = {};
  config.max_difference = -1;
  EXPECT_EQ(complaint(config), "gap_interpolation.max_difference = -1: must be within 0..4094");
}

}  // namespace gap_interpolation_test
}  // namespace parallax::test
