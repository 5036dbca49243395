// SPDX-License-Identifier: Apache-2.0
// What the matcher keeps in memory: how many bytes, and that it takes its time.
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "tests/platform/error_of.hpp"
#include "tests/timing/in_child.hpp"
#include "tests/timing/machine_bench.hpp"

namespace parallax::test {
namespace matcher_store_test {

struct Outcome {
  std::map<std::string, double> bytes;  // a frame, by port
  double period = 0;                    // s
};

constexpr std::int64_t kFrames = 9;

Outcome run(const std::vector<std::string>& assignments, int width, int height) {
  std::istringstream in(in_child([&] {
    const MachineConfig config = preset(assignments);
    const EncodedMap map = encode(lens_map(width, height, config.rectification.range));
    MachineInput input;
    input.width = width;
    input.height = height;
    input.map = &map;
    input.frames = kFrames;
    input.timing_only = true;
    const Machine machine("machine", config, input);
    sc_core::sc_start();
    std::ostringstream out;
    const auto& all = machine.snapshots();
    out << (all[kFrames - 1].time - all[kFrames - 3].time).to_seconds() / 2 << "\n";
    for (std::size_t i = 0; i < machine.ports().size(); ++i) {
      out << machine.ports()[i]->name << " "
          << static_cast<double>(all[kFrames - 1].ports[i].bytes - all[kFrames - 3].ports[i].bytes) / 2
          << "\n";
    }
    return out.str();
  }));
  Outcome outcome;
  in >> outcome.period;
  std::string name;
  for (double bytes = 0; in >> name >> bytes;) outcome.bytes[name] = bytes;
  return outcome;
}

// Frames overlap, so a window holds a whole number of frames of an engine to within what is under way.
constexpr double kUnderWay = 0.03;

TEST(MatcherStore, NothingIsKeptByDefault) {
  const Outcome outcome = run({}, 160, 64);
  EXPECT_EQ(outcome.bytes.size(), 7u);
}

TEST(MatcherStore, RowsOfPathCostsGoOutAndComeBack) {
  // 128 costs and a minimum of 9 bits (2 * 24 + 255 = 303) for three paths: 436 B a pixel; rows of 160 pixels
  // are padded to bursts of 128 B; all but the last are written, all but the first read.
  const Outcome outcome = run({"matching.path_storage=memory"}, 160, 64);
  const double row = 545 * 128;
  EXPECT_NEAR(outcome.bytes.at("buffer_row_write"), 63 * row, kUnderWay * 63 * row);
  EXPECT_NEAR(outcome.bytes.at("buffer_row_read"), 63 * row, kUnderWay * 63 * row);
  EXPECT_EQ(outcome.bytes.count("buffer_frame_write"), 0u);
  // More than the memory gives in the time of a frame: 3.97 GB/s at most.
  EXPECT_GT(outcome.period, 2 * 63 * row / 4.0e9);
}

TEST(MatcherStore, ASecondPassNeedsItsFrame) {
  // 128 sums of five paths, 11 bits (5 * 303), and two codes: 182 B a pixel; the rows of both passes on chip.
  const Outcome outcome = run({"matching.paths=w,nw,n,ne,e,sw,s,se"}, 160, 64);
  const double frame = 64 * (228 * 128);
  EXPECT_NEAR(outcome.bytes.at("buffer_frame_write"), frame, kUnderWay * frame);
  EXPECT_NEAR(outcome.bytes.at("buffer_frame_read"), frame, kUnderWay * frame);
  EXPECT_EQ(outcome.bytes.count("buffer_row_write"), 0u);
}

TEST(MatcherStore, BothTogetherAndInTiles) {
  const std::vector<std::string> tiles{"matching.paths=n,s", "matching.iterations=1", "tiles.limit=128",
                                       "tiles.disparities_in_margin=false"};
  std::vector<std::string> memory = tiles;
  memory.emplace_back("matching.path_storage=memory");
  // Two tiles of 112 columns. One path a pass: 33 values of 9 bits, 38 B; sums of 9 bits and two codes: 42 B.
  const Outcome outcome = run(memory, 160, 64);
  const double rows = 2 * 2 * 63 * (34 * 128);
  const double frame = 2 * 64 * (37 * 128);
  EXPECT_NEAR(outcome.bytes.at("buffer_row_write"), rows, kUnderWay * rows);
  EXPECT_NEAR(outcome.bytes.at("buffer_row_read"), rows, kUnderWay * rows);
  EXPECT_NEAR(outcome.bytes.at("buffer_frame_write"), frame, kUnderWay * frame);
  EXPECT_NEAR(outcome.bytes.at("buffer_frame_read"), frame, kUnderWay * frame);
}

TEST(MatcherStore, ANarrowPortHoldsTheMatcherUp) {
  const std::vector<std::string> wide{"matching.path_storage=memory", "memory.model=bus",
                                      "memory.bytes_per_cycle=1024",  "memory.latency_cycles=0",
                                      "memory.latency_ns=0",          "software.response_ns=0"};
  std::vector<std::string> narrow = wide;
  narrow.emplace_back("dma.buffer.data_bits=64");
  // 436 B a pixel at 8 B a cycle, over 63 rows of 160 pixels.
  EXPECT_GE(run(narrow, 160, 64).period, 63 * 160 * 54.5 / 188e6);
  EXPECT_LT(run(wide, 160, 64).period, 63 * 160 * 54.5 / 188e6 / 3);
}

TEST(MatcherStore, MustFitIntoTheMemory) {
  // 64 rows of 11 bursts of 128 B: sums of one path of 16 disparities, 9 bits, and two codes of 24 bits.
  EXPECT_EQ(error_of([] {
              const MachineConfig config =
                  preset({"matching.paths=n,s", "matching.parallelism=8", "matching.iterations=2",
                          "memory.size_bytes=1048576", "memory_map.buffer.address=1000000"});
              lay_out_memory(config, 160, 64, EncodedMap{}, matcher_store(config, 160, 64));
            }),
            "memory.size_bytes = 1048576 is too small: buffer at 0xf4240 with 245760 B ends at 1245760");
}

}  // namespace matcher_store_test
}  // namespace parallax::test
