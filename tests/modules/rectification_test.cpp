// SPDX-License-Identifier: Apache-2.0
#include "modules/rectification.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tests/modules/naive_rectification.hpp"
#include "tests/modules/random_maps.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace rectification_test {

using Image = std::vector<Gray>;

Image noise_image(int width, int height, std::uint32_t seed) {
  std::mt19937 random(seed);
  Image image(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (Gray& pixel : image) {
    pixel = static_cast<Gray>(random());
  }
  return image;
}

Image naive(const Image& image, const RectificationMap& map, Offset OffsetPair::*side,
            RectificationConfig::Rounding rounding) {
  std::vector<Offset> offsets;
  for (const OffsetPair& pair : map.offsets) {
    offsets.push_back(pair.*side);
  }
  return test::naive_rectify(image, map.width, map.height, offsets, map.range.fraction_bits,
                             rounding == RectificationConfig::Rounding::kNearest);
}

// Runs one frame; the map comes `maps_ahead` rows before the image rows where it can.
std::pair<Image, Image> run(Rectification& kernel, const RectificationMap& map, const Image& left,
                            const Image& right, int maps_ahead) {
  std::pair<Image, Image> out;
  const Rectification::Emit emit = [&](const Gray* l, const Gray* r) {
    out.first.insert(out.first.end(), l, l + map.width);
    out.second.insert(out.second.end(), r, r + map.width);
  };
  int map_row = 0;
  for (int y = 0; y < map.height; ++y) {
    while (map_row < map.height && (!kernel.can_push_images() || map_row < y + maps_ahead)) {
      kernel.push_map(map.row(map_row++), emit);
    }
    const std::ptrdiff_t begin = static_cast<std::ptrdiff_t>(y) * map.width;
    kernel.push_images(left.data() + begin, right.data() + begin, emit);
  }
  while (map_row < map.height) {
    kernel.push_map(map.row(map_row++), emit);
  }
  return out;
}

void expect_as_reference(const RectificationMap& map, RectificationConfig::Rounding rounding, int maps_ahead,
                         std::uint32_t seed) {
  RectificationConfig config;
  config.range = map.range;
  config.rounding = rounding;
  Rectification kernel(config, map.width, map.height);
  for (std::uint32_t frame = 0; frame < 2; ++frame) {
    const Image left = noise_image(map.width, map.height, seed + 2 * frame);
    const Image right = noise_image(map.width, map.height, seed + 2 * frame + 1);
    const auto [rectified_left, rectified_right] = run(kernel, map, left, right, maps_ahead);
    ASSERT_TRUE(rectified_left == naive(left, map, &OffsetPair::left, rounding));
    ASSERT_TRUE(rectified_right == naive(right, map, &OffsetPair::right, rounding));
    ASSERT_EQ(kernel.map_rows_waiting(), 0);
  }
}

RC_GTEST_PROP(Rectification, AgreesWithTheReference, ()) {
  const OffsetRange range{2 * *rc::gen::inRange(0, 45) + 1, *rc::gen::inRange(0, 9)};
  const auto rounding =
      *rc::gen::element(RectificationConfig::Rounding::kNearest, RectificationConfig::Rounding::kTruncate);
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const RectificationMap map =
      test::noise_map(*rc::gen::inRange(1, 60), *rc::gen::inRange(1, 60), range, seed);
  expect_as_reference(map, rounding, *rc::gen::inRange(-60, 60), seed);
}

TEST(Rectification, AgreesWithTheReferenceOnOddSizes) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 100}, {100, 1}, {200, 90}}) {
    expect_as_reference(test::lens_map(width, height, {}), RectificationConfig::Rounding::kNearest, 1, 7);
    expect_as_reference(test::chessboard_map(width, height, {}), RectificationConfig::Rounding::kTruncate, 1,
                        8);
  }
}

TEST(Rectification, AgreesWithTheReferenceAtTheLargestSize) {
  expect_as_reference(test::lens_map(1856, 1856, {}), RectificationConfig::Rounding::kNearest, 1, 9);
}

TEST(Rectification, IdentityLeavesTheImages) {
  const Image left = noise_image(50, 50, 1);
  const Image right(left.size(), 255);
  Rectification kernel({}, 50, 50);
  const auto out = run(kernel, identity_map(50, 50), left, right, 1);
  EXPECT_TRUE(out.first == left);
  EXPECT_TRUE(out.second == right);
}

TEST(Rectification, RowsAppearAsSoonAsTheWindowIsFilled) {
  constexpr int kHeight = 100;
  Rectification kernel({}, 8, kHeight);
  const RectificationMap map = identity_map(8, kHeight);
  const Image image = noise_image(8, kHeight, 3);
  int rows = 0;
  const Rectification::Emit count = [&](const Gray*, const Gray*) { ++rows; };
  for (int y = 0; y < kHeight; ++y) {
    kernel.push_map(map.row(y), count);
    kernel.push_images(&image[static_cast<std::size_t>(8 * y)], &image[static_cast<std::size_t>(8 * y)],
                       count);
    // Output row y - 39 needs input row y; the last input row releases the rest.
    ASSERT_EQ(rows, y == kHeight - 1 ? kHeight : std::max(0, y - 38));
  }
}

TEST(Rectification, HoldsNoMoreThanTheWindow) {
  Rectification kernel({}, 8, 100);
  const Image row(8);
  const Rectification::Emit none = [](const Gray*, const Gray*) {};
  for (int y = 0; y < 40; ++y) {
    ASSERT_TRUE(kernel.can_push_images());
    kernel.push_images(row.data(), row.data(), none);
  }
  EXPECT_FALSE(kernel.can_push_images());
  EXPECT_THROW(kernel.push_images(row.data(), row.data(), none), std::logic_error);
  kernel.push_map(identity_map(8, 1).row(0), none);
  EXPECT_TRUE(kernel.can_push_images());
  EXPECT_EQ(kernel.storage_bits(), 2 * 79 * 8 * 8);
  EXPECT_EQ(kernel.look_ahead_rows(), 39);
  EXPECT_EQ(kernel.look_ahead_pixels(), 39);
}

TEST(Rectification, RefusesAnOffsetBeyondTheWindow) {
  Rectification kernel({}, 4, 4);
  std::vector<OffsetPair> row(4);
  row[3].left.dy = 1249;
  EXPECT_THROW(kernel.push_map(row.data(), [](const Gray*, const Gray*) {}), std::invalid_argument);
  RectificationConfig config;
  config.range.window = 78;
  EXPECT_THROW(Rectification(config, 4, 4), UserError);
}

}  // namespace rectification_test
}  // namespace parallax
