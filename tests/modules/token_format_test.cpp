// SPDX-License-Identifier: Apache-2.0
// How tokens lie on wires: every value comes back, field by field in the order that is stated.
#include "modules/token_format.hpp"

#include <gtest/gtest.h>

#include <random>

#include "modules/bit_packer.hpp"
#include "modules/token_formats.hpp"

namespace parallax {
namespace token_format_test {

TEST(BitVector, KeepsFieldsApartOverWords) {
  BitVector bits(200);
  bits.set(0, 3, 0b101);
  bits.set(60, 10, 0x3FF);
  bits.set(136, 64, 0x0123456789ABCDEF);
  EXPECT_EQ(bits.get(0, 3), 0b101u);
  EXPECT_EQ(bits.get(3, 57), 0u);
  EXPECT_EQ(bits.get(60, 10), 0x3FFu);
  EXPECT_EQ(bits.get(70, 64), 0u);
  EXPECT_EQ(bits.get(136, 64), 0x0123456789ABCDEFu);
  bits.set(60, 10, 0x155);
  EXPECT_EQ(bits.get(60, 10), 0x155u);
  EXPECT_EQ(bits.get(70, 64), 0u);
}

TEST(BitVector, HasNoBitsBeyondItsWidth) {
  BitVector bits(12);
  EXPECT_THROW(bits.get(0, 13), std::out_of_range);
  EXPECT_THROW(bits.get(12, 1), std::out_of_range);
  EXPECT_THROW(bits.set(5, 0, 0), std::out_of_range);
}

TEST(BitVector, LiesInMemoryLowestByteFirst) {
  BitVector bits(20);
  bits.set(0, 20, 0xABCDE);
  const std::vector<std::uint8_t> bytes = bits.bytes();
  EXPECT_EQ(bytes, (std::vector<std::uint8_t>{0xDE, 0xBC, 0x0A}));
  EXPECT_EQ(BitVector::from_bytes(bytes.data(), 20), bits);
}

TEST(TokenFormats, FieldsFollowOneAnotherFromBitZeroOn) {
  const TokenFormat format = cost_group_format(32, 11);
  EXPECT_EQ(format.width(), Bits(352));
  EXPECT_EQ(format.all()[0].name, "cost_0");
  EXPECT_EQ(format.all()[31].name, "cost_31");
  EXPECT_EQ(format.all()[31].low, 341u);
  EXPECT_EQ(gray_format().width(), Bits(8));
  EXPECT_EQ(disparity_format().width(), Bits(12));
  EXPECT_EQ(census_code_format(24).width(), Bits(24));
  EXPECT_EQ(offset_pair_format(13).width(), Bits(52));
  EXPECT_EQ(word_format(8).width(), Bits(64));
  // Three paths of 128 costs and a minimum; and sums with two codes.
  EXPECT_EQ(path_record_format(3, 128, 9).width(), Bits(3 * 129 * 9));
  EXPECT_EQ(frame_record_format(128, 11, 24).width(), Bits(128 * 11 + 2 * 24));
  EXPECT_EQ(frame_record_format(128, 0, 24).width(), Bits(48));
}

TEST(TokenFormats, SeveralLieSideBySide) {
  const TokenFormat pairs = offset_pair_format(13).several(2);
  EXPECT_EQ(pairs.width(), Bits(104));
  EXPECT_EQ(pairs.all()[4].name, "left_dx_1");
  EXPECT_EQ(pairs.all()[4].low, 52u);
  EXPECT_TRUE(pairs.all()[4].is_signed);
  EXPECT_EQ(gray_format().several(1).all()[0].name, "grey");
}

TEST(TokenFormats, ADisparityIsItsTwelveBits) {
  const TokenFormat format = disparity_format();
  for (const std::uint16_t value : std::initializer_list<std::uint16_t>{0, 1, 0xABC, kInvalidDisparity}) {
    EXPECT_EQ(unpack_disparity(format, pack(format, Disparity{value, Cause::kMatched})).value, value);
  }
  EXPECT_THROW(pack(format, Disparity{0x1000, Cause::kMatched}), std::out_of_range);
}

TEST(TokenFormats, EveryTokenComesBack) {
  std::mt19937 random(1);
  const auto below = [&random](std::uint64_t end) {
    return ((std::uint64_t{random()} << 32) | random()) % end;
  };
  for (int round = 0; round < 200; ++round) {
    const auto gray = static_cast<Gray>(below(256));
    EXPECT_EQ(unpack_gray(gray_format(), pack(gray_format(), gray)), gray);

    const auto offset_bits = 2 + below(15);
    const TokenFormat offsets = offset_pair_format(offset_bits);
    const auto offset = [&] {
      const auto limit = std::int64_t{1} << (offset_bits - 1);
      return static_cast<std::int16_t>(
          static_cast<std::int64_t>(below(static_cast<std::uint64_t>(2 * limit))) - limit);
    };
    const OffsetPair pair{{offset(), offset()}, {offset(), offset()}};
    EXPECT_EQ(unpack_offset_pair(offsets, pack(offsets, pair)), pair);

    const auto code_bits = 1 + below(63);
    const TokenFormat codes = census_code_format(code_bits);
    const CensusCode code = below(std::uint64_t{1} << code_bits);
    EXPECT_EQ(unpack_code(codes, pack_code(codes, code)), code);

    const auto number = 1 + below(256);
    const TokenFormat costs = cost_group_format(number, 12);
    std::vector<Cost> sums(number);
    for (Cost& cost : sums) cost = static_cast<Cost>(below(4096));
    std::vector<Cost> back(number);
    unpack_costs(costs, pack_costs(costs, sums.data()), back.data());
    EXPECT_EQ(back, sums);
  }
}

TEST(TokenFormats, AValueThatIsTooLargeIsReported) {
  const TokenFormat offsets = offset_pair_format(8);
  EXPECT_THROW(pack(offsets, OffsetPair{{128, 0}, {}}), std::out_of_range);
  EXPECT_NO_THROW(pack(offsets, OffsetPair{{-128, 127}, {}}));
  EXPECT_THROW(pack_code(census_code_format(4), 16), std::out_of_range);
}

TEST(BitPacker, LaysFieldsOutAsAFormatDoes) {
  const TokenFormat format = path_record_format(2, 5, 9);
  std::mt19937 random(3);
  BitPacker packer;
  std::vector<std::uint8_t> expected;
  for (int token = 0; token < 3; ++token) {
    BitVector bus = format.bus();
    for (std::size_t i = 0; i < format.all().size(); ++i) {
      const std::int64_t value = random() % 512;
      format.set(bus, i, value);
      packer.field(static_cast<std::uint64_t>(value), 9);
    }
    packer.end_token();
    const std::vector<std::uint8_t> bytes = bus.bytes();
    expected.insert(expected.end(), bytes.begin(), bytes.end());
  }
  EXPECT_EQ(packer.take(), expected);
  EXPECT_TRUE(packer.take().empty());
}

}  // namespace token_format_test
}  // namespace parallax
