// SPDX-License-Identifier: Apache-2.0
#include "modules/map_file.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <string>

#include "tests/modules/random_maps.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace map_file_test {

std::string message(const std::function<void()>& run) {
  try {
    run();
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

std::string message(const std::vector<std::uint8_t>& bytes) {
  return message([&] { from_file_bytes(bytes, "m.map"); });
}

std::vector<std::uint8_t> example() { return to_file_bytes(encode(test::lens_map(37, 11, {}))); }

// The checksum of a file that another writer got wrong in some other way: bit by bit, from the definition.
void refresh_checksum(std::vector<std::uint8_t>& bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (std::size_t i = 8; i < bytes.size(); ++i) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc & 1U) != 0 ? (crc >> 1) ^ 0xEDB88320U : crc >> 1;
    }
  }
  for (std::size_t i = 0; i < 4; ++i) {
    bytes[4 + i] = static_cast<std::uint8_t>(~crc >> (8 * i));
  }
}

TEST(MapFile, ReadsWhatItWrote) {
  const EncodedMap map = encode(test::noise_map(37, 11, {41, 3}, 5));
  const EncodedMap read = from_file_bytes(to_file_bytes(map), "a.map");
  EXPECT_EQ(read.width, 37);
  EXPECT_EQ(read.height, 11);
  EXPECT_TRUE(read.range == map.range);
  EXPECT_EQ(read.bytes, map.bytes);
  EXPECT_EQ(read.row_bytes, map.row_bytes);
}

TEST(MapFile, LayoutIsTheDocumentedOne) {
  const std::vector<std::uint8_t> bytes = to_file_bytes(encode(identity_map(300, 2, {79, 5})));
  // 300 px: 19 blocks of two zero bytes a row.
  ASSERT_EQ(bytes.size(), 32U + 2 * 4 + 2 * 38);
  const std::vector<std::uint8_t> expected = {1,   0, 5, 16, 79, 0, 0, 0, 44, 1, 0, 0, 2,  0, 0, 0,
                                              116, 0, 0, 0,  0,  0, 0, 0, 38, 0, 0, 0, 38, 0, 0, 0};
  EXPECT_EQ(std::string(bytes.begin(), bytes.begin() + 4), "PLXM");
  EXPECT_EQ(std::vector<std::uint8_t>(bytes.begin() + 8, bytes.begin() + 40), expected);
}

TEST(MapFile, TruncationAtEveryByteIsDetected) {
  const std::vector<std::uint8_t> bytes = example();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::string line =
        message(std::vector<std::uint8_t>(bytes.begin(), bytes.begin() + static_cast<long>(size)));
    ASSERT_FALSE(line.empty()) << size;
    ASSERT_EQ(line.find('\n'), std::string::npos);
    if (size >= 4) {
      ASSERT_NE(line.find("truncated"), std::string::npos) << line;
    }
  }
}

TEST(MapFile, EverySingleBitErrorIsDetected) {
  const std::vector<std::uint8_t> bytes = example();
  for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
    std::vector<std::uint8_t> flipped = bytes;
    flipped[bit / 8] = static_cast<std::uint8_t>(flipped[bit / 8] ^ (1U << (bit % 8)));
    ASSERT_FALSE(message(flipped).empty()) << bit;
  }
}

TEST(MapFile, MessagesSayWhatAndWhere) {
  const std::vector<std::uint8_t> good = example();
  EXPECT_EQ(message({'a', 'b'}), "m.map: not a rectification map: the first four bytes are not PLXM");
  EXPECT_EQ(message(std::vector<std::uint8_t>(good.begin(), good.begin() + 20)),
            "m.map: truncated rectification map: 20 bytes, the header alone has 32");
  std::vector<std::uint8_t> bad = good;
  bad.pop_back();
  EXPECT_EQ(message(bad), "m.map: truncated rectification map: it ends at byte " +
                              std::to_string(bad.size()) + " of " + std::to_string(good.size()));
  bad = good;
  bad.push_back(0);
  EXPECT_EQ(message(bad), "m.map: corrupt rectification map: 1 bytes follow its end at byte " +
                              std::to_string(good.size()));
  bad = good;
  bad[8] = 2;
  EXPECT_EQ(message(bad), "m.map: rectification map of version 2 (byte 8); this program reads version 1");
  bad = good;
  bad.back() = static_cast<std::uint8_t>(bad.back() ^ 1U);
  EXPECT_NE(message(bad).find("m.map: corrupt rectification map: checksum"), std::string::npos)
      << message(bad);
}

TEST(MapFile, AnotherWritersMistakesAreNamed) {
  const auto changed = [](std::size_t at, std::uint8_t value) {
    std::vector<std::uint8_t> bytes = example();
    bytes[at] = value;
    refresh_checksum(bytes);
    return message(bytes);
  };
  EXPECT_EQ(changed(11, 8), "m.map: malformed rectification map: unknown block length at byte 11");
  EXPECT_EQ(changed(14, 1), "m.map: malformed rectification map: reserved bytes are not zero at byte 14");
  EXPECT_EQ(changed(16, 0), "m.map: malformed rectification map: width outside 1..65535 at byte 16");
  EXPECT_EQ(changed(20, 0), "m.map: malformed rectification map: height outside 1..65535 at byte 20");
  EXPECT_EQ(changed(22, 9), "m.map: malformed rectification map: height outside 1..65535 at byte 20");
  EXPECT_EQ(changed(21, 255),
            "m.map: malformed rectification map: more rows than the file can hold at byte 20");
  EXPECT_EQ(changed(12, 78), "m.map: rectification.window: 78 is not an odd number in 1..2047");
  EXPECT_EQ(changed(10, 77), "m.map: rectification.fraction_bits: 77 is outside 0..8");
  EXPECT_NE(changed(33, 200).find("malformed rectification map: row 0 of"), std::string::npos);
  EXPECT_NE(changed(32, static_cast<std::uint8_t>(example()[32] + 1)).find("its rows end at byte"),
            std::string::npos);
}

}  // namespace map_file_test
}  // namespace parallax
