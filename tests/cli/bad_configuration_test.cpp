// SPDX-License-Identifier: Apache-2.0
// Keys that are fine alone and not together, or not with this input: one line each, and nothing is run.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/cli/program.hpp"

namespace parallax {
namespace bad_configuration_test {

class BadConfiguration : public ::testing::Test {
 protected:
  /// What a timing run says after "parallax: error: "; the files that the keys come from, which stand in
  /// brackets at its end, are left out.
  std::string error(const std::string& arguments, const std::string& size = "64x48") const {
    const test::Outcome outcome =
        program_("run --timing-only --no-verdict -q --size " + size + " " + arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    const std::vector<std::string> lines = test::lines(outcome.err);
    const std::string prefix = "parallax: error: ";
    EXPECT_EQ(lines.size(), 1U) << outcome.err;
    if (lines.empty() || lines[0].rfind(prefix, 0) != 0) return outcome.err;
    return lines[0].substr(prefix.size(), lines[0].find(" (memory.") - prefix.size());
  }

  test::Program program_;
};

TEST_F(BadConfiguration, TheMemorysQueuesAndSize) {
  EXPECT_EQ(error("--set memory.write_high=33"),
            "memory.write_high = 33: must be at most memory.write_queue = 32");
  EXPECT_EQ(error("--set memory.write_low=26"),
            "memory.write_low = 26: must be below memory.write_high = 26");
  EXPECT_EQ(error("--set memory.size_bytes=1099511627776")
                .rfind("memory.size_bytes = 1099511627776: must be at most the devices' size, 1073741824 B "
                       "(dram.rows * dram.columns * dram.banks * dram.bus_bytes)",
                       0),
            0U);
}

TEST_F(BadConfiguration, ParallelRowsAndTokens) {
  const auto line = [](int rows, int pixels, int groups) {
    return fmt::format(
        "matching.parallel_rows = {}: must be a multiple or a divisor of pipeline.pixels_per_token = {}, and "
        "divide "
        "pipeline.pixels_per_token * matching.iterations = {}",
        rows, pixels, groups);
  };
  const auto starts = [&](const std::string& keys, const std::string& text) {
    EXPECT_EQ(error(keys).rfind(text + " (matching.", 0), 0U) << error(keys);
  };
  starts("--set matching.parallel_rows=3", line(3, 1, 4));
  starts("--set matching.parallel_rows=8", line(8, 1, 4));
  starts("--set matching.parallel_rows=4 --set pipeline.pixels_per_token=6", line(4, 6, 24));
  starts("--set matching.parallel_rows=2 --set matching.path_storage=memory",
         "matching.parallel_rows = 2: needs matching.path_storage = \"on_chip\", costs of rows at once do "
         "not pass "
         "the memory");
  for (const char* start : {"carry", "delay_line", "first_column"}) {
    starts(std::string("--set matching.parallel_rows=2 --set matching.path_start=") + start,
           "matching.parallel_rows = 2: needs matching.path_start = \"cost\" or \"clamp\", with others paths "
           "go on over the ends of rows");
  }
  EXPECT_EQ(
      error("--set pipeline.pixels_per_token=3"),
      "pipeline.pixels_per_token = 3: rows of 64 px are no whole number of tokens; image.width_granularity = "
      "3 pads them");
}

TEST_F(BadConfiguration, CostsOfWhatDoesNotComeIn) {
  const auto starts = [&](const std::string& keys, const std::string& text) {
    EXPECT_EQ(error(keys).rfind(text + " (", 0), 0U) << error(keys);
  };
  starts("--set census.enabled=false",
         "matching.cost = \"hamming\": needs census.enabled = true; grey values have "
         "\"absolute_difference\"");
  starts("--set matching.cost=absolute_difference",
         "matching.cost = \"absolute_difference\": needs census.enabled = false, it is of grey values");
}

TEST_F(BadConfiguration, KeysOfTheOtherMemory) {
  EXPECT_EQ(
      error("--set memory.model=bus --set dram.cl=9"),
      "--set dram.cl=9: dram.cl has no effect with memory.model = \"bus\"; set memory.model = \"dram\"");
  EXPECT_EQ(error("--set memory.model=bus --set memory.device=ddr4-2400-x64"),
            "--set memory.device=ddr4-2400-x64: memory.device has no effect with memory.model = \"bus\"; set "
            "memory.model = \"dram\"");
  EXPECT_EQ(error("--set memory.bytes_per_cycle=4"),
            "--set memory.bytes_per_cycle=4: memory.bytes_per_cycle has no effect with memory.model = "
            "\"dram\"; set memory.device or dram.bus_bytes, or memory.model = \"bus\"");
  EXPECT_EQ(error("--set clocks.memory_hz=5e8"),
            "--set clocks.memory_hz=5e8: clocks.memory_hz has no effect with memory.model = \"dram\"; set "
            "memory.device or dram.clock_period_ps, or memory.model = \"bus\"");
}

TEST_F(BadConfiguration, AMemoryDeviceThatThereIsNot) {
  const std::string text = error("--set memory.device=ddr3-1066");
  EXPECT_EQ(text.rfind("--set memory.device=ddr3-1066: memory.device: no memory device 'ddr3-1066' in ", 0),
            0U)
      << text;
  EXPECT_NE(text.find("; the nearest is ddr3-1066-x32"), std::string::npos) << text;
}

TEST_F(BadConfiguration, BuffersThatOverlap) {
  EXPECT_EQ(error("--set memory_map.left.address=4096 --set memory_map.right.address=4096"),
            "memory_map: left 0 at 0x1000 with 3072 B reaches to 0x1c00, beyond right 0 at 0x1000; set "
            "memory_map.<name>.address or .pitch");
}

TEST_F(BadConfiguration, RowsOfPackedPixelsThatEndWithinAByte) {
  EXPECT_EQ(error("--set camera.format=mono12_packed --set image.width_granularity=1", "65x48"),
            "camera.format = \"mono12_packed\": rows of 65 px are no whole number of bytes; "
            "image.width_granularity = 2 pads them");
}

TEST_F(BadConfiguration, WhatASceneOrASingleFrameCannotDo) {
  EXPECT_EQ(error("--set rectification.window=1"),
            "the built-in scene is distorted, but rectification.window = 1 rectifies nothing: --rectified is "
            "the scene without distortion");
  EXPECT_EQ(error("--relax --timing-frames 1"),
            "--relax compares frame rates, and one frame has none: --timing-frames must be at least 2");
}

}  // namespace bad_configuration_test
}  // namespace parallax
