// SPDX-License-Identifier: Apache-2.0
#include "modules/texture.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "platform/images/image_codecs.hpp"
#include "tests/modules/disparity_image.hpp"
#include "tests/modules/naive_texture.hpp"
#include "tests/modules/user_error.hpp"
#include "tests/paths.hpp"

namespace parallax::test {
namespace texture_test {

using GrayImage = Image<Gray>;

/// amplitude 0: flat; 255: saturated noise; between: weak texture around a mean, with plain stretches.
GrayImage random_image(int width, int height, std::uint_fast32_t seed, int amplitude) {
  std::mt19937 random(seed);
  GrayImage image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int noise = static_cast<int>(random() % static_cast<unsigned>(amplitude + 1));
      const bool plain = ((x / 9) + (y / 7)) % 3 == 0;
      image.at(x, y) =
          static_cast<Gray>(amplitude == 255 ? (noise > 127 ? 255 : 0) : 100 + (plain ? 0 : noise));
    }
  }
  return image;
}

/// Rows of image and disparity in an order drawn at random, each in its own pace.
DisparityImage filtered_at_random_pace(Texture& texture, const GrayImage& image,
                                       const DisparityImage& disparities, std::mt19937& random) {
  DisparityImage output(image.width, image.height);
  int emitted = 0;
  const auto collect = [&](const Disparity* row) {
    ASSERT_LT(emitted, image.height);
    std::copy(row, row + image.width, &output.at(0, emitted++));
  };
  int image_rows = 0;
  int disparity_rows = 0;
  while (image_rows < image.height || disparity_rows < image.height) {
    const bool take_image =
        disparity_rows == image.height || (image_rows < image.height && random() % 2 == 0);
    if (take_image) {
      texture.push_image(image.row(image_rows++), collect);
    } else {
      texture.push_disparity(disparities.row(disparity_rows++), collect);
    }
    const int scored =
        image_rows == image.height ? image.height : std::max(0, image_rows - texture.look_ahead_rows());
    EXPECT_EQ(emitted, std::min(scored, disparity_rows));
  }
  return output;
}

TEST(Texture, EqualsTheDefinition) {
  std::mt19937 random(1);
  for (const int window : {3, 5, 9, 15}) {
    for (const int threshold : {0, 1, 10, 63}) {
      TextureConfig config;
      config.window = window;
      config.threshold = threshold;
      for (const Size size : kOddSizes) {
        Texture texture(config, size.width, size.height);
        for (const int amplitude : {0, 3, 20, 255}) {
          const GrayImage image = random_image(size.width, size.height, random(), amplitude);
          const DisparityImage input =
              random_disparities(size.width, size.height, random(), Content::kPatches);
          expect_equal(filtered_at_random_pace(texture, image, input, random),
                       naive_texture(config, image, input));
          if (HasFatalFailure()) return;
        }
      }
    }
  }
}

RC_GTEST_PROP(Texture, EqualsTheDefinitionForAnyConfiguration, ()) {
  TextureConfig config;
  config.window = 2 * *rc::gen::inRange(1, 8) + 1;
  config.threshold = *rc::gen::inRange(0, 64);
  const int width = *rc::gen::inRange(1, 40);
  const int height = *rc::gen::inRange(1, 40);
  std::mt19937 random(*rc::gen::arbitrary<unsigned>());
  Texture texture(config, width, height);
  const GrayImage image = random_image(width, height, random(), *rc::gen::inRange(0, 40));
  const DisparityImage input = random_disparities(width, height, random(), Content::kPatches);
  RC_ASSERT(filtered_at_random_pace(texture, image, input, random).pixels ==
            naive_texture(config, image, input).pixels);
}

TEST(Texture, LargestImage) {
  const int size = 1856;
  const GrayImage image = random_image(size, size, 5, 12);
  const DisparityImage input = random_disparities(size, size, 6, Content::kPatches);
  std::mt19937 random(7);
  Texture texture({}, size, size);
  expect_equal(filtered_at_random_pace(texture, image, input, random), naive_texture({}, image, input));
}

TEST(Texture, RealImage) {
  const cv::Mat gray = read_image(shared_data("kitti2012_000000/left.png"), cv::IMREAD_GRAYSCALE);
  if (gray.empty()) GTEST_SKIP() << "no stereo data here";
  GrayImage image(gray.cols, gray.rows);
  std::copy(gray.begin<Gray>(), gray.end<Gray>(), image.pixels.begin());
  const DisparityImage input = random_disparities(gray.cols, gray.rows, 1, Content::kFlat);
  std::mt19937 random(2);
  Texture texture({}, gray.cols, gray.rows);
  expect_equal(filtered_at_random_pace(texture, image, input, random), naive_texture({}, image, input));
}

TEST(Texture, ThresholdIsExact) {
  // A ramp of one grey level per px: the mean contrast is 1, the score 32.
  GrayImage ramp(40, 9);
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 40; ++x) ramp.at(x, y) = static_cast<Gray>(x);
  }
  const DisparityImage input = random_disparities(40, 9, 0, Content::kFlat);
  std::mt19937 random(3);
  for (const auto& [threshold, cause] : {std::pair{32, Cause::kMatched}, std::pair{33, Cause::kTexture}}) {
    TextureConfig config;
    config.threshold = threshold;
    DisparityImage valid = input;
    for (Disparity& d : valid.pixels) d = {100, Cause::kMatched};
    Texture texture(config, 40, 9);
    EXPECT_EQ(filtered_at_random_pace(texture, ramp, valid, random).at(20, 4).cause, cause) << threshold;
  }
}

TEST(Texture, DisparitiesMayStartTheNextFrameFirst) {
  TextureConfig config;
  const GrayImage image = random_image(20, 10, 1, 10);
  const DisparityImage first = random_disparities(20, 10, 1, Content::kPatches);
  const DisparityImage second = random_disparities(20, 10, 2, Content::kPatches);
  std::vector<Disparity> output;
  const auto collect = [&](const Disparity* row) { output.insert(output.end(), row, row + 20); };
  Texture texture(config, 20, 10);
  for (const DisparityImage* frame : {&first, &second}) {
    for (int y = 0; y < 10; ++y) texture.push_disparity(frame->row(y), collect);
  }
  for (int frame = 0; frame < 2; ++frame) {
    for (int y = 0; y < 10; ++y) texture.push_image(image.row(y), collect);
  }
  std::vector<Disparity> expected = naive_texture(config, image, first).pixels;
  const std::vector<Disparity> rest = naive_texture(config, image, second).pixels;
  expected.insert(expected.end(), rest.begin(), rest.end());
  EXPECT_EQ(output, expected);
}

TEST(Texture, DisabledPassesTheInputAtOnce) {
  TextureConfig config;
  config.enabled = false;
  Texture texture(config, 30, 20);
  EXPECT_EQ(texture.look_ahead_rows(), 0);
  EXPECT_EQ(texture.look_ahead_pixels(), 0);
  EXPECT_EQ(texture.storage_bits(), 0);
  const DisparityImage input = random_disparities(30, 20, 1, Content::kPatches);
  const GrayImage flat = random_image(30, 20, 1, 0);
  std::vector<Disparity> output;
  const auto collect = [&](const Disparity* row) { output.insert(output.end(), row, row + 30); };
  for (int y = 0; y < 20; ++y) {
    texture.push_disparity(input.row(y), collect);
    EXPECT_EQ(output.size(), 30U * static_cast<unsigned>(y + 1));
    texture.push_image(flat.row(y), collect);
  }
  EXPECT_EQ(output, input.pixels);
}

TEST(Texture, DeclaresWhatItsCircuitNeeds) {
  TextureConfig config;
  config.window = 5;
  const Texture texture(config, 640, 480);
  EXPECT_EQ(texture.look_ahead_rows(), 2);
  EXPECT_EQ(texture.look_ahead_pixels(), 2);
  EXPECT_EQ(texture.storage_bits(), 4 * 640 * 8 + 2 * 5 * 8 + 5 * 12);
}

TEST(Texture, SaysWhatIsWrongWithItsConfiguration) {
  TextureConfig config;
  EXPECT_EQ(complaint(config), "");
  config.threshold = 64;
  EXPECT_EQ(complaint(config), "texture.threshold = 64: must be within 0..63");
  config.threshold = -1;
  EXPECT_EQ(complaint(config), "texture.threshold = -1: must be within 0..63");
  config = {};
  for (const int window : {1, 4, 17}) {
    config.window = window;
    EXPECT_EQ(complaint(config),
              "texture.window = " + std::to_string(window) + ": must be odd and within 3..15");
    EXPECT_THROW(Texture(config, 8, 8), UserError);
  }
}

}  // namespace texture_test
}  // namespace parallax::test
