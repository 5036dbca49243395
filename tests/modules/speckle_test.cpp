// SPDX-License-Identifier: Apache-2.0
#include "modules/speckle.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/modules/disparity_image.hpp"
#include "tests/modules/naive_speckle.hpp"
#include "tests/modules/user_error.hpp"

namespace parallax::test {
namespace speckle_test {

TEST(Speckle, EqualsTheDefinition) {
  for (const int iterations : {0, 1, 2, 4}) {
    for (const int window : {3, 11, 31}) {
      for (const int percent : {0, 25, 100}) {
        for (const int max_difference : {0, 16, 4094}) {
          SpeckleConfig config;
          config.iterations = iterations;
          config.window = window;
          config.min_similar_percent = percent;
          config.max_difference = max_difference;
          if (window == 31 && (iterations == 4 || percent == 100)) continue;  // slow, and nothing new
          expect_matches_reference<Speckle>(config, naive_speckle);
          if (HasFatalFailure()) return;
        }
      }
    }
  }
}

RC_GTEST_PROP(Speckle, EqualsTheDefinitionForAnyConfiguration, ()) {
  SpeckleConfig config;
  config.iterations = *rc::gen::inRange(0, 5);
  config.window = 2 * *rc::gen::inRange(1, 8) + 1;
  config.min_similar_percent = *rc::gen::inRange(0, 101);
  config.max_difference = *rc::gen::element(0, 1, 8, 16, 100, 4094);
  const int width = *rc::gen::inRange(1, 40);
  const int height = *rc::gen::inRange(1, 40);
  const auto content = *rc::gen::elementOf(kContents);
  const DisparityImage input = random_disparities(width, height, *rc::gen::arbitrary<unsigned>(), content);
  Speckle speckle(config, width, height);
  RC_ASSERT(filtered(speckle, input).pixels == naive_speckle(config, input).pixels);
}

TEST(Speckle, LargestImage) {
  SpeckleConfig config;
  config.window = 5;
  const DisparityImage input = random_disparities(1856, 1856, 6, Content::kPatches);
  Speckle speckle(config, 1856, 1856);
  expect_equal(filtered(speckle, input), naive_speckle(config, input));
}

/// A surface at 40 px with a square of `side` pixels at 60 px on it.
DisparityImage surface_with_square(int side) {
  DisparityImage image(60, 60);
  for (Disparity& d : image.pixels) d = {40 * 16, Cause::kMatched};
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) image.at(30 + x, 30 + y).value = 60 * 16;
  }
  return image;
}

TEST(Speckle, RemovesAClusterBelowTheMinimumAndKeepsOneAtTheMinimum) {
  SpeckleConfig config;
  config.iterations = 1;
  config.window = 11;
  config.min_similar_percent = 20;  // of 121 px: 24.2, so 25 px are needed
  Speckle speckle(config, 60, 60);
  EXPECT_EQ(filtered(speckle, surface_with_square(4)).at(31, 31),
            (Disparity{kInvalidDisparity, Cause::kSpeckle}));
  EXPECT_EQ(filtered(speckle, surface_with_square(5)).at(32, 32), (Disparity{60 * 16, Cause::kMatched}));
}

TEST(Speckle, ASecondPassRemovesWhatTheFirstLeftThin) {
  // Of a cross, the first pass takes the arms' ends, the second what they supported.
  DisparityImage image(40, 40);
  for (int i = -6; i <= 6; ++i) image.at(20 + i, 20) = image.at(20, 20 + i) = {500, Cause::kMatched};
  SpeckleConfig config;
  config.window = 5;
  config.min_similar_percent = 32;  // 8 of 25 px
  const auto valid_after = [&](int iterations) {
    config.iterations = iterations;
    Speckle speckle(config, 40, 40);
    const DisparityImage output = filtered(speckle, image);
    return std::count_if(output.pixels.begin(), output.pixels.end(),
                         [](const Disparity& d) { return d.valid(); });
  };
  EXPECT_EQ(valid_after(0), 25);
  EXPECT_GT(valid_after(1), 0);
  EXPECT_LT(valid_after(1), 25);
  EXPECT_LT(valid_after(2), valid_after(1));
}

TEST(Speckle, DeclaresWhatItsCircuitNeeds) {
  SpeckleConfig config;
  config.window = 11;
  config.iterations = 2;
  const Speckle twice(config, 640, 480);
  EXPECT_EQ(twice.look_ahead_rows(), 10);
  EXPECT_EQ(twice.look_ahead_pixels(), 10);
  EXPECT_EQ(twice.storage_bits(), 2 * (10 * 640 + 121) * 12);
  config.iterations = 0;
  const Speckle off(config, 640, 480);
  EXPECT_EQ(off.look_ahead_rows(), 0);
  EXPECT_EQ(off.look_ahead_pixels(), 0);
  EXPECT_EQ(off.storage_bits(), 0);
}

TEST(Speckle, SaysWhatIsWrongWithItsConfiguration) {
  SpeckleConfig config;
  EXPECT_EQ(complaint(config), "");
  config.iterations = 5;
  EXPECT_EQ(complaint(config), "speckle.iterations = 5: must be within 0..4");
  EXPECT_THROW(Speckle(config, 8, 8), UserError);
  config = {};
  config.window = 8;
  EXPECT_EQ(complaint(config), "speckle.window = 8: must be odd and within 3..31");
  config = {};
  config.min_similar_percent = 101;
  EXPECT_EQ(complaint(config), "speckle.min_similar_percent = 101: must be within 0..100");
  config = {};
  config.max_difference = 4095;
  EXPECT_EQ(complaint(config), "speckle.max_difference = 4095: must be within 0..4094");
}

}  // namespace speckle_test
}  // namespace parallax::test
