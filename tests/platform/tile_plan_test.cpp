// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/tile_plan.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/modules/random_maps.hpp"
#include "tests/platform/error_of.hpp"

namespace parallax::test {
namespace tile_plan_test {

DisparityRange range(int offset, int count) {
  DisparityRange range;
  range.offset = offset;
  range.count = count;
  return range;
}

TEST(TilePlan, OneTileUpToTheLimit) {
  const TilePlan plan = plan_tiles({}, range(0, 128), 1024);
  EXPECT_EQ(plan.width, 1024);
  ASSERT_EQ(plan.tiles.size(), 1u);
  EXPECT_EQ(plan.tiles[0].keep_end, 1024);
}

TEST(TilePlan, TwoTilesByHand) {
  const TilePlan plan = plan_tiles({}, range(0, 128), 1280);  // (1280 + 32 + 128 + 32) / 2
  EXPECT_EQ(plan.width, 736);
  ASSERT_EQ(plan.tiles.size(), 2u);
  EXPECT_EQ(plan.tiles[0].begin, 0);
  EXPECT_EQ(plan.tiles[0].keep_end, 704);
  EXPECT_EQ(plan.tiles[1].begin, 544);
  EXPECT_EQ(plan.tiles[1].keep_begin, 704);
  EXPECT_EQ(plan.tiles[1].keep_end, 1280);
}

TEST(TilePlan, RangeAndOffsetLowerTheLargestImage) {
  EXPECT_EQ(largest_width({}, range(0, 128)), 1856);
  EXPECT_EQ(largest_width({}, range(0, 256)), 1728);
  EXPECT_EQ(largest_width({}, range(100, 128)), 1756);
  EXPECT_EQ(
      error_of([] { plan_tiles({}, range(100, 128), 1757); }),
      "images of 1757 columns do not fit: 2 tiles of 1024 columns (tiles.largest_number, tiles.limit) that "
      "overlap by 32 + 32 + disparity offset 100 + range 128 hold 1756");
  TileConfig narrow;
  narrow.disparities_in_margin = false;
  narrow.limit = 100;
  narrow.largest_number = 3;
  EXPECT_EQ(largest_width(narrow, range(0, 256)), 172);
  EXPECT_EQ(
      error_of([&] { plan_tiles(narrow, range(0, 256), 174); }),
      "images of 174 columns do not fit: 3 tiles of 100 columns (tiles.largest_number, tiles.limit) that "
      "overlap by 32 + 32 hold 172");
  narrow.limit = 40;  // less than the margins: a second tile would add nothing
  EXPECT_EQ(largest_width(narrow, range(0, 256)), 40);
}

TEST(TilePlan, MarginsAreEven) {
  TileConfig config;
  config.left_margin = 3;
  EXPECT_EQ(error_of([&] { config.validate(); }),
            "tiles.left_margin = 3: must be even, two pixels share five bytes of the output");
  config = {};
  config.right_margin = 5;
  EXPECT_EQ(error_of([&] { config.validate(); }),
            "tiles.right_margin = 5: must be even, two pixels share five bytes of the output");
  config = {};
  config.limit = 193;
  EXPECT_EQ(error_of([&] { config.validate(); }),
            "tiles.limit = 193: must be even, two pixels share five bytes of the output");
  EXPECT_EQ(
      error_of([&] { plan_tiles({}, range(0, 128), 1101); }),
      "images of 1101 columns in tiles: the width must be even, two pixels share five bytes of the output; "
      "image.width_granularity = 2 pads them");
}

TEST(TilePlan, IsOfWholeTokens) {
  EXPECT_EQ(
      error_of([] { plan_tiles({}, range(0, 128), 642, 4); }),
      "pipeline.pixels_per_token = 4: rows of 642 px are no whole number of tokens; image.width_granularity "
      "= 4 pads them");
  EXPECT_EQ(plan_tiles({}, range(0, 128), 640, 4).width, 640);
  // The seams stay where they are: (1296 + 192) / 2 = 744 columns are 186 tokens of 4 px, and 46 1/2 of 16.
  EXPECT_EQ(plan_tiles({}, range(0, 128), 1296, 4).width, 744);
  EXPECT_EQ(error_of([] { plan_tiles({}, range(0, 128), 1296, 16); }),
            "pipeline.pixels_per_token = 16: tiles of 744 px are no whole number of tokens; other margins "
            "(tiles.left_margin, tiles.right_margin) make other tiles");
}

RC_GTEST_PROP(TilePlan, CoversEachColumnOnceWithItsMargins, ()) {
  TileConfig config;
  config.limit = 2 * *rc::gen::inRange(4u, 150u);
  config.largest_number = *rc::gen::inRange(1u, 65u);
  config.left_margin = 2 * *rc::gen::inRange(0u, 30u);
  config.right_margin = 2 * *rc::gen::inRange(0u, 30u);
  config.disparities_in_margin = *rc::gen::arbitrary<bool>();
  const DisparityRange disparities = range(*rc::gen::inRange(0, 20), *rc::gen::inRange(1, 60));
  const int largest = largest_width(config, disparities);
  const int width = 2 * *rc::gen::inRange(1, largest / 2 + 1);
  const TilePlan plan = plan_tiles(config, disparities, width);
  RC_ASSERT(plan.width <= static_cast<int>(config.limit));
  RC_ASSERT(plan.tiles.size() <= config.largest_number);
  const int left = static_cast<int>(config.left_margin) +
                   (config.disparities_in_margin ? disparities.offset + disparities.count : 0);
  int column = 0;
  for (const Tile& tile : plan.tiles) {
    RC_ASSERT(tile.keep_begin == column);
    RC_ASSERT(tile.keep_end > tile.keep_begin);
    RC_ASSERT(tile.begin >= 0);
    RC_ASSERT(tile.begin + plan.width <= width);
    if (tile.keep_begin > 0) RC_ASSERT(tile.keep_begin - tile.begin >= left);
    if (tile.keep_end < width) {
      RC_ASSERT(tile.begin + plan.width - tile.keep_end >= static_cast<int>(config.right_margin));
      RC_ASSERT(tile.keep_end % 2 == 0);
    }
    column = tile.keep_end;
  }
  RC_ASSERT(column == width);
}

TEST(TilePlan, TilesThatAddLittleAreNoMoreThanNeeded) {
  TileConfig config;
  config.limit = 194;
  config.largest_number = 64;
  config.disparities_in_margin = false;
  config.left_margin = 160;
  config.right_margin = 32;
  const TilePlan plan = plan_tiles(config, range(0, 128), 224);  // two columns from one to the next
  ASSERT_EQ(plan.tiles.size(), 16u);
  EXPECT_EQ(plan.tiles.back().begin, 224 - 194);
}

TEST(CutMap, IsTheMapsColumnsTileByTile) {
  const OffsetRange offsets;
  const EncodedMap map = encode(lens_map(90, 20, offsets));
  TileConfig config;
  config.limit = 64;
  config.left_margin = 8;
  config.right_margin = 4;
  const TilePlan plan = plan_tiles(config, range(0, 12), 90);
  ASSERT_EQ(plan.tiles.size(), 2u);
  const EncodedMap cut = cut_map(map, plan);
  const RectificationMap whole = decode(map);
  const RectificationMap tiles = decode(cut);
  ASSERT_EQ(cut.width, plan.width);
  ASSERT_EQ(cut.height, 40);
  for (std::size_t t = 0; t < 2; ++t) {
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < plan.width; ++x) {
        const OffsetPair& a =
            tiles.offsets[(t * 20 + static_cast<std::size_t>(y)) * static_cast<std::size_t>(plan.width) +
                          static_cast<std::size_t>(x)];
        const OffsetPair& b = whole.offsets[static_cast<std::size_t>(y * 90 + plan.tiles[t].begin + x)];
        ASSERT_TRUE(a.left.dx == b.left.dx && a.left.dy == b.left.dy && a.right.dx == b.right.dx &&
                    a.right.dy == b.right.dy)
            << t << " " << x << " " << y;
      }
    }
  }
}

}  // namespace tile_plan_test
}  // namespace parallax::test
