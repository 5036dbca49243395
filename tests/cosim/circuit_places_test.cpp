// SPDX-License-Identifier: Apache-2.0
// Which place of the image a circuit is told beside a token.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/cosim/make_cpp_circuit.hpp"

namespace parallax::test {
namespace circuit_places_test {

struct Circuit {
  const char* stage;
  int in_bits, out_bits;
  int last_group = 0;
};

// What comes beside each token of the first frame at a circuit that hands on the last token of each pixel.
std::string places(const std::string& arguments, const Circuit& circuit) {
  const Program program;
  make_cpp_circuit(
      program, "c",
      fmt::format("IN(clk, 1) IN(in_valid, 1) IN(in_data, {}) IN(in_x, 8) IN(in_y, 8) IN(in_group, 4) "
                  "IN(in_last, 1) IN(in_first, 1) OUT(out_valid, 1) OUT(out_data, {})",
                  circuit.in_bits, circuit.out_bits),
      fmt::format("static FILE* const file = std::fopen(\"places\", \"w\");\n"
                  "if (rises && in_valid) std::fprintf(file, \"%d %d %d %d %d\\n\", int(in_y), int(in_x), "
                  "int(in_group), int(in_last), int(in_first));\n"
                  "std::fflush(file);\n"
                  "out_valid = in_valid && in_group == {};\nout_data = in_data & (1u << {}) - 1;\n",
                  circuit.last_group, circuit.out_bits));
  const Outcome outcome = program(
      fmt::format("run --no-verdict --timing-frames 1 {} --circuit {}=c.so", arguments, circuit.stage));
  EXPECT_LE(outcome.code, 1) << outcome.err;
  return program.read("places");
}

TEST(CircuitPlaces, OfPixels) {
  std::string expected;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 32; ++x) expected += fmt::format("{} {} 0 {:d} {:d}\n", y, x, x == 31, y + x == 0);
  }
  EXPECT_EQ(places("--size 32x16", {"noise_reduction", 12, 12}), expected);
}

// The first pixel of each token.
TEST(CircuitPlaces, OfTokensOfSeveralPixels) {
  std::string expected;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 32; x += 2) expected += fmt::format("{} {} 0 {:d} {:d}\n", y, x, x == 30, y + x == 0);
  }
  EXPECT_EQ(places("--size 32x16 -s pipeline.pixels_per_token=2", {"noise_reduction", 24, 24}), expected);
}

// Each of a pixel's tokens.
TEST(CircuitPlaces, OfGroupsOfCosts) {
  std::string expected;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 32; ++x) {
      for (int group = 0; group < 3; ++group) {
        expected +=
            fmt::format("{} {} {} {:d} {:d}\n", y, x, group, x == 31 && group == 2, y + x + group == 0);
      }
    }
  }
  EXPECT_EQ(
      places("--size 32x16 -s matching.parallelism=4 -s matching.iterations=3", {"subpixel", 44, 12, 2}),
      expected);
}

// Tile by tile, counted from its left column on.
TEST(CircuitPlaces, OfTiles) {
  std::string expected;
  for (int tile = 0; tile < 2; ++tile) {
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 88; ++x) expected += fmt::format("{} {} 0 {:d} {:d}\n", y, x, x == 87, y + x == 0);
    }
  }
  EXPECT_EQ(places("--size 128x16 -d 32 -s tiles.limit=96 -s tiles.left_margin=8 -s tiles.right_margin=8",
                   {"noise_reduction", 12, 12}),
            expected);
}

}  // namespace circuit_places_test
}  // namespace parallax::test
