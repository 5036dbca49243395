// SPDX-License-Identifier: Apache-2.0
#include "platform/estimate/memory_mapping.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/paths.hpp"

namespace parallax::test {
namespace memory_mapping_test {

using Read = MemoryShape::Read;
using Kind = MemoryMapping::Kind;

DeviceFile family(const std::string& name = "7-series") {
  return load_family(name, {source_path("platform/presets")});
}

struct Case {
  std::int64_t words, bits;
  Read read;
  Kind kind;
  std::int64_t units;  // RAMB18, or LUTs
};

// What yosys 0.23 makes of these memories.
TEST(MemoryMapping, IsWhatASynthesiserMakes) {
  const DeviceFile device = family();
  const Case cases[] = {
      {1024, 632, Read::kRegistered, Kind::kBlockRam, 36},   // 79 rows of 8 bits
      {640, 632, Read::kRegistered, Kind::kBlockRam, 36},    // no fewer for fewer columns
      {2560, 864, Read::kRegistered, Kind::kBlockRam, 120},  // path costs
      {640, 3483, Read::kRegistered, Kind::kBlockRam, 194},  // a pixel a word: shape, not bits
      {1500, 12, Read::kRegistered, Kind::kBlockRam, 2},
      {1500, 12, Read::kAtOnce, Kind::kLutRam, 96 * 4},
      {64, 12, Read::kRegistered, Kind::kLutRam, 4 * 4},
      {65, 12, Read::kRegistered, Kind::kLutRam, 6 * 4},
      {128, 12, Read::kRegistered, Kind::kLutRam, 8 * 4},
      {256, 8, Read::kRegistered, Kind::kLutRam, 12 * 4},
      {128, 24, Read::kRegistered, Kind::kBlockRam, 1},
      {256, 12, Read::kRegistered, Kind::kBlockRam, 1},
      {64, 72, Read::kRegistered, Kind::kLutRam, 24 * 4},
      {32, 632, Read::kRegistered, Kind::kLutRam, 106 * 4},
  };
  for (const Case& c : cases) {
    const MemoryMapping mapping = map_memory({c.words, c.bits, c.read}, device);
    EXPECT_EQ(mapping.kind, c.kind) << c.words << " x " << c.bits;
    EXPECT_EQ(mapping.resources.block_rams + mapping.resources.ram_luts, c.units)
        << c.words << " x " << c.bits;
  }
}

// As many primitives of one shape as cover it, for the best of all shapes: never fewer than its bits ask for,
// and never more than those of 1024 x 18.
TEST(MemoryMapping, LiesBetweenItsBitsAndOneShape) {
  const DeviceFile device = family();
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    const std::int64_t words = 1 + static_cast<std::int64_t>(random() % 9000);
    const std::int64_t bits = 1 + static_cast<std::int64_t>(random() % 900);
    const MemoryMapping mapping = map_memory({words, bits}, device);
    if (mapping.kind != Kind::kBlockRam) continue;
    constexpr std::int64_t kBlock = 18 * 1024;
    EXPECT_GE(mapping.resources.block_rams * kBlock, words * bits);
    EXPECT_LE(mapping.resources.block_rams, 2 * ((words + 1023) / 1024) * ((bits + 17) / 18))
        << words << " x " << bits;
  }
}

TEST(MemoryMapping, NothingIsNothing) {
  EXPECT_EQ(map_memory({0, 8}, family()).kind, Kind::kNone);
  EXPECT_EQ(map_memory({8, 0}, family()).resources.luts(), 0);
}

TEST(MemoryMapping, AnM10kIsTenKilobits) {
  const MemoryMapping mapping = map_memory({1024, 80}, family("cyclone-v"));
  EXPECT_EQ(mapping.kind, Kind::kBlockRam);
  EXPECT_EQ(mapping.resources.block_rams, 8);
}

TEST(MemoryMapping, DelaysAreShiftRegistersWhereThereAreAny) {
  EXPECT_EQ(map_delay(2, 8, family()).registers, 16);
  EXPECT_EQ(map_delay(32, 8, family()).shift_luts, 8);
  EXPECT_EQ(map_delay(33, 8, family()).shift_luts, 16);
  EXPECT_EQ(map_delay(32, 8, family("ecp5")).registers, 256);
}

TEST(MemoryMapping, AProductIsCutIntoWholeDsps) {
  EXPECT_EQ(multipliers(17, 21, family()), 1);
  EXPECT_EQ(multipliers(18, 24, family()), 2);
  EXPECT_EQ(multipliers(19, 26, family()), 4);
  EXPECT_EQ(multipliers(19, 26, family("ecp5")), 2);
}

}  // namespace memory_mapping_test
}  // namespace parallax::test
