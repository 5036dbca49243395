// SPDX-License-Identifier: Apache-2.0
#include "modules/map_decoder.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <algorithm>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "modules/map_codec.hpp"
#include "tests/modules/naive_map_code.hpp"
#include "tests/modules/random_maps.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace map_decoder_test {

// Decodes frame after frame from one continuous stream, as the hardware does, and compares with the
// reference.
void expect_as_reference(const RectificationMap& map, int frames) {
  const EncodedMap encoded = encode(map);
  const test::NaiveDecoded expected = test::naive_decode(encoded);
  MapDecoder decoder(map.range, map.width, map.height);
  const auto width = static_cast<std::size_t>(map.width);
  for (int frame = 0; frame < frames; ++frame) {
    std::size_t begin = 0;
    for (std::size_t y = 0; y < static_cast<std::size_t>(map.height); ++y) {
      std::vector<OffsetPair> row(width);
      std::vector<std::uint32_t> end_bits(width);
      const std::uint8_t* bytes = encoded.bytes.data() + begin;
      const std::size_t used = decoder.push(bytes, encoded.bytes.size() - begin, row.data());
      ASSERT_EQ(used, encoded.row_bytes[y]);
      map_code_ends(bytes, used, map.range, static_cast<int>(y), end_bits);
      ASSERT_EQ(end_bits, expected.end_bits[y]);
      for (std::size_t x = 0; x < width; ++x) {
        ASSERT_EQ(row[x].left.dx, expected.components[0][y * width + x]);
        ASSERT_EQ(row[x].left.dy, expected.components[1][y * width + x]);
        ASSERT_EQ(row[x].right.dx, expected.components[2][y * width + x]);
        ASSERT_EQ(row[x].right.dy, expected.components[3][y * width + x]);
        ASSERT_TRUE(row[x] == map.row(static_cast<int>(y))[x]);
      }
      begin += used;
    }
  }
}

RC_GTEST_PROP(MapDecoder, AgreesWithTheReferenceOnNoise, ()) {
  const int fraction_bits = *rc::gen::inRange(0, 9);
  const int window = 2 * *rc::gen::inRange(0, 64) + 1;
  expect_as_reference(test::noise_map(*rc::gen::inRange(1, 60), *rc::gen::inRange(1, 8),
                                      {window, fraction_bits}, *rc::gen::arbitrary<std::uint32_t>()),
                      2);
}

TEST(MapDecoder, AgreesWithTheReferenceOnLensesAndOddSizes) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 30}, {30, 1}, {33, 31}, {320, 240}}) {
    expect_as_reference(test::lens_map(width, height, {}), 2);
    expect_as_reference(test::chessboard_map(width, height, {}), 1);
  }
}

TEST(MapDecoder, DeclaresOneRowOfStorage) {
  EXPECT_EQ(MapDecoder({}, 640, 480).storage_bits(), 640 * 4 * 12);
  EXPECT_EQ(MapDecoder({}, 640, 480).look_ahead_rows(), 0);
  EXPECT_EQ(MapDecoder({}, 640, 480).look_ahead_pixels(), 0);
}

class MalformedRow : public ::testing::Test {
 protected:
  // Row 1 of an 18-pixel map is replaced by `bytes`.
  static std::string message(const std::vector<std::uint8_t>& bytes) {
    MapDecoder decoder({79, 5}, 18, 4);
    std::vector<OffsetPair> row(18);
    const std::vector<std::uint8_t> zeros(4);
    decoder.push(zeros.data(), zeros.size(), row.data());
    std::string line;
    try {
      decoder.push(bytes.data(), bytes.size(), row.data());
    } catch (const UserError& error) {
      line = error.what();
      // The decoder is ready for a new frame.
      for (int y = 0; y < 4; ++y) {
        EXPECT_EQ(decoder.push(zeros.data(), zeros.size(), row.data()), 4U);
      }
    }
    return line;
  }
  // The same row, of which only the codes' ends are asked for.
  static std::string message_of_ends(const std::vector<std::uint8_t>& bytes) {
    std::vector<std::uint32_t> end_bits(18);
    try {
      map_code_ends(bytes.data(), bytes.size(), {79, 5}, 1, end_bits);
    } catch (const UserError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(MalformedRow, IsRefusedWhereTheCodesEndToo) {
  for (const std::vector<std::uint8_t>& bytes :
       {std::vector<std::uint8_t>{0, 0, 0}, {}, {0, 0, 0x08, 0, 0xFF}, {0xD0, 0, 0, 0}}) {
    EXPECT_EQ(message_of_ends(bytes), message(bytes));
    EXPECT_NE(message_of_ends(bytes), "");
  }
}

TEST_F(MalformedRow, EndsBeforeAHeader) {
  EXPECT_EQ(message({0, 0, 0}),
            "rectification map: row 1, pixel 16 (byte 2 of the row): the row ends before the block's header");
  EXPECT_EQ(message({}),
            "rectification map: row 1, pixel 0 (byte 0 of the row): the row ends before the block's header");
}

TEST_F(MalformedRow, EndsWithinABlock) {
  EXPECT_EQ(message({0, 0, 0x08, 0, 0xFF}),
            "rectification map: row 1, pixel 16 (byte 4 of the row): the row ends within the block");
}

TEST_F(MalformedRow, ResidualWiderThanAnOffset) {
  EXPECT_EQ(message({0xD0, 0, 0, 0}),
            "rectification map: row 1, pixel 0 (byte 0 of the row): a residual is wider than an offset");
}

TEST_F(MalformedRow, FillIsNotZero) {
  EXPECT_EQ(message({0, 0, 0x01, 0, 0x04}),
            "rectification map: row 1, pixel 17 (byte 4 of the row): the bits that fill the last byte are "
            "not zero");
}

TEST_F(MalformedRow, OffsetBeyondTheWindow) {
  // Right dy of pixel 16: 12 bits, 1249.
  EXPECT_EQ(message({0, 0, 0, 0xC0, 0xE1, 0x04, 0x00}),
            "rectification map: row 1, pixel 16: an offset is beyond the window of 79 px");
}

TEST(MapDecoder, RefusesABadRange) { EXPECT_THROW(MapDecoder({78, 5}, 4, 4), UserError); }

RC_GTEST_PROP(MapDecoder, CodesOfArbitraryBytesEndWithinThem, (const std::vector<std::uint8_t>& bytes)) {
  std::vector<std::uint32_t> end_bits(40);
  try {
    map_code_ends(bytes.data(), bytes.size(), {}, 0, end_bits);
    RC_ASSERT(end_bits.back() <= bytes.size() * 8);
    RC_ASSERT(std::is_sorted(end_bits.begin(), end_bits.end()));
  } catch (const UserError&) {
  }
}

RC_GTEST_PROP(MapDecoder, SurvivesArbitraryBytes, (const std::vector<std::uint8_t>& bytes)) {
  MapDecoder decoder({}, 40, 3);
  std::vector<OffsetPair> row(40);
  try {
    for (int y = 0; y < 3; ++y) {
      RC_ASSERT(decoder.push(bytes.data(), bytes.size(), row.data()) <= bytes.size());
    }
  } catch (const UserError&) {
  }
}

}  // namespace map_decoder_test
}  // namespace parallax
