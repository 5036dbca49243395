// SPDX-License-Identifier: Apache-2.0
#include "modules/map_codec.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "modules/map_decoder.hpp"
#include "tests/modules/random_maps.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace map_codec_test {

void expect_lossless(const RectificationMap& map) {
  const EncodedMap encoded = encode(map);
  ASSERT_EQ(encoded.row_bytes.size(), static_cast<std::size_t>(map.height));
  ASSERT_EQ(std::accumulate(encoded.row_bytes.begin(), encoded.row_bytes.end(), std::size_t{0}),
            encoded.bytes.size());
  for (const std::uint32_t row : encoded.row_bytes) {
    ASSERT_GE(row, least_row_bytes(map.width));
    ASSERT_LE(row, worst_row_bytes(map.width, map.range));
  }
  const RectificationMap decoded = decode(encoded);
  ASSERT_EQ(decoded.width, map.width);
  ASSERT_EQ(decoded.height, map.height);
  ASSERT_TRUE(decoded.range == map.range);
  ASSERT_TRUE(decoded.offsets == map.offsets);
}

TEST(OffsetRange, BitsHoldTheLimit) {
  EXPECT_EQ((OffsetRange{79, 5}.limit()), 1248);
  EXPECT_EQ((OffsetRange{79, 5}.offset_bits()), 12);
  EXPECT_EQ((OffsetRange{1, 5}.offset_bits()), 1);
  EXPECT_EQ((OffsetRange{3, 0}.offset_bits()), 2);
  EXPECT_EQ((OffsetRange{127, 8}.offset_bits()), 15);
}

TEST(OffsetRange, RefusesWhatTheFormatCannotHold) {
  const auto message = [](int window, int fraction_bits) -> std::string {
    try {
      OffsetRange{window, fraction_bits}.validate();
    } catch (const UserError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message(78, 5), "rectification.window: 78 is not an odd number in 1..2047");
  EXPECT_EQ(message(-1, 5), "rectification.window: -1 is not an odd number in 1..2047");
  EXPECT_EQ(message(79, 9), "rectification.fraction_bits: 9 is outside 0..8");
  EXPECT_EQ(message(201, 8),
            "rectification.window: 201 with 8 fraction bits needs offsets of more than 15 bits; at most 127 "
            "with this "
            "many fraction bits");
  EXPECT_EQ(message(127, 8), "");
  EXPECT_EQ(message(1023, 5), "");
}

RC_GTEST_PROP(MapCodec, IsLosslessOnNoise, ()) {
  const int fraction_bits = *rc::gen::inRange(0, 9);
  const int window = 2 * *rc::gen::inRange(0, 64) + 1;
  const int width = *rc::gen::inRange(1, 70);
  const int height = *rc::gen::inRange(1, 12);
  expect_lossless(
      test::noise_map(width, height, {window, fraction_bits}, *rc::gen::arbitrary<std::uint32_t>()));
}

RC_GTEST_PROP(MapCodec, AppendedRowsAreCodedAsIfPushed, ()) {
  const OffsetRange range{79, 5};
  const int width = *rc::gen::inRange(1, 70);
  const int height = *rc::gen::inRange(1, 8);
  const int above = *rc::gen::inRange(1, height + 1);
  const RectificationMap map = test::noise_map(width, height, range, *rc::gen::arbitrary<std::uint32_t>());
  MapEncoder upper(width, height, range);
  MapEncoder lower(width, std::max(1, height - above), range);
  for (int y = 0; y < height; ++y) (y < above ? upper : lower).push(map.row(y));
  if (above < height) upper.append(lower);
  const EncodedMap joined = upper.take();
  const EncodedMap pushed = encode(map);
  RC_ASSERT(joined.bytes == pushed.bytes);
  RC_ASSERT(joined.row_bytes == pushed.row_bytes);
}

TEST(MapCodec, IsLosslessOnJumpsBetweenTheEndsOfTheRange) {
  for (const int fraction_bits : {0, 5, 8}) {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 40}, {40, 1}, {16, 16}, {17, 5}, {65, 33}}) {
      expect_lossless(test::chessboard_map(width, height, {79, fraction_bits}));
    }
  }
}

TEST(MapCodec, NoiseReachesAndNeverExceedsTheWorstCase) {
  // 3 blocks of 16 bit and 48 pixels of 4 * 12 bit: 294 bytes.
  ASSERT_EQ(worst_row_bytes(48, {}), 294U);
  const EncodedMap encoded = encode(test::noise_map(48, 200, {}, 1));
  EXPECT_EQ(*std::max_element(encoded.row_bytes.begin(), encoded.row_bytes.end()), 294U);
}

TEST(MapCodec, IdentityTakesTheHeadersAlone) {
  const EncodedMap encoded = encode(identity_map(640, 480));
  EXPECT_EQ(encoded.bytes.size(), 480U * 40U * 2U);
  EXPECT_DOUBLE_EQ(encoded.bytes_per_pixel(), 0.0625);
}

TEST(MapCodec, LensesThatUseTheWholeWindowStayBelowOneByte) {
  for (const auto& [width, height] : {std::pair{640, 480}, {1280, 960}, {1856, 1856}}) {
    for (const int fraction_bits : {4, 5, 6}) {
      const RectificationMap map = test::lens_map(width, height, {79, fraction_bits});
      const EncodedMap encoded = encode(map);
      EXPECT_LE(encoded.bytes_per_pixel(), 1.0)
          << width << "x" << height << ", " << fraction_bits << " fraction bits";
      EXPECT_TRUE(decode(encoded).offsets == map.offsets);
    }
  }
}

TEST(MapCodec, TilesAreMapsOfTheirOwn) {
  const RectificationMap map = test::lens_map(100, 20, {});
  const RectificationMap tile = map.columns(37, 50);
  EXPECT_EQ(tile.width, 50);
  EXPECT_TRUE(tile.row(7)[3] == map.row(7)[40]);
  expect_lossless(tile);
  EXPECT_THROW(map.columns(60, 41), std::out_of_range);
}

TEST(MapCodec, RefusesAMapBeyondItsOwnRange) {
  RectificationMap map = identity_map(4, 4);
  map.offsets[5].right.dy = -1249;
  EXPECT_THROW(encode(map), std::invalid_argument);
  map.offsets.pop_back();
  EXPECT_THROW(encode(map), std::invalid_argument);
  EXPECT_THROW(identity_map(0, 4), UserError);
}

TEST(MapCodec, RowLengthsMustBeTheRowsOwn) {
  const EncodedMap good = encode(test::lens_map(64, 8, {}));
  const auto message = [](const EncodedMap& map) -> std::string {
    try {
      decode(map);
    } catch (const UserError& error) {
      return error.what();
    }
    return "";
  };
  EncodedMap longer = good;
  longer.row_bytes[0] += 1;
  EXPECT_NE(message(longer).find("row 0 takes"), std::string::npos) << message(longer);
  EncodedMap trailing = good;
  trailing.bytes.push_back(0);
  EXPECT_NE(message(trailing).find("the rows end at byte"), std::string::npos) << message(trailing);
  EncodedMap cut = good;
  cut.bytes.pop_back();
  EXPECT_NE(message(cut).find("row 7 ends at byte"), std::string::npos) << message(cut);
}

TEST(MapEncoder, GivesAMapAfterItsLastRowOnly) {
  MapEncoder encoder(4, 2, {});
  const std::vector<OffsetPair> row(4);
  encoder.push(row.data());
  EXPECT_THROW(encoder.take(), std::logic_error);
  encoder.push(row.data());
  const EncodedMap map = encoder.take();
  EXPECT_EQ(map.row_bytes.size(), 2U);
  EXPECT_TRUE(map.bytes == encode(identity_map(4, 2)).bytes);
  EXPECT_THROW(MapEncoder(0, 2, {}), std::invalid_argument);
}

}  // namespace map_codec_test
}  // namespace parallax
