// SPDX-License-Identifier: Apache-2.0
#include "tlm/dram_replay.hpp"

#include <gtest/gtest.h>

namespace parallax::test {
namespace dram_replay_test {

using Trace = std::vector<TraceRequest>;

ReplayResult run(const Trace& trace, const DramTiming& timing = {}, std::size_t window = 16) {
  return replay(trace, timing, {}, DramMapping::kRowBankColumn, window);
}

DramTiming without_refresh() {
  DramTiming timing;
  timing.refi = 0;
  return timing;
}

TEST(DramReplay, UnloadedReadsOf64Bytes) {
  // 64 bytes are two bursts of four clocks: the second one ends four clocks after the first.
  const Trace closed{{10000 * 1.875, false, 0, 64}};
  EXPECT_DOUBLE_EQ(run(closed, without_refresh()).latency_largest, 43.125);
  Trace hit = closed;
  hit.push_back({20000 * 1.875, false, 64, 64});
  EXPECT_DOUBLE_EQ(run(hit, without_refresh()).latency_sum, 43.125 + 30);
  Trace conflict = closed;
  conflict.push_back({20000 * 1.875, false, 8 * 4096, 64});
  EXPECT_DOUBLE_EQ(run(conflict, without_refresh()).latency_sum, 43.125 + 56.25);
}

TEST(DramReplay, AStreamOfRowHitsIsThePeakLessTheRowsOpened) {
  Trace trace;
  for (std::uint64_t i = 0; i < 64; ++i) trace.push_back({0, false, i * 64, 64});  // one row
  const ReplayResult result = run(trace, without_refresh());
  EXPECT_EQ(result.clocks, 1 + 7 + 7 + 128 * 4);
  EXPECT_EQ(result.bytes, 64u * 64);
  EXPECT_EQ(result.commands.activates, 1u);
  EXPECT_TRUE(result.saturating);
}

TEST(DramReplay, AWindowOfOneReadWaitsOutEachLatency) {
  Trace trace;
  for (std::uint64_t i = 0; i < 10; ++i) trace.push_back({0, false, i * 64, 64});
  // A row hit takes 16 clocks; the next read enters in the clock of the last beat.
  EXPECT_EQ(run(trace, without_refresh(), 1).clocks, 23 + 9 * 16);
}

TEST(DramReplay, WritesArePostedAndNotInTheWindow) {
  Trace trace{{1, true, 0, 64}, {1, false, 4096, 64}};
  const ReplayResult result = run(trace, without_refresh(), 1);
  EXPECT_EQ(result.writes, 1u);
  EXPECT_EQ(result.reads, 1u);
  EXPECT_FALSE(result.saturating);
  EXPECT_LT(result.latency_largest, 100);
}

TEST(DramReplay, RequestsAreCutAt64BytesAndIntoBursts) {
  const ReplayResult result = run({{0, false, 60, 72}, {0, true, 1, 1}}, without_refresh());  // 60..131
  EXPECT_EQ(result.reads, 3u);
  EXPECT_EQ(result.writes, 1u);
  EXPECT_EQ(result.commands.reads, 1u + 2 + 1);
  EXPECT_EQ(result.commands.writes, 1u);
}

TEST(DramReplay, BuffersInOneBankCostBandwidth) {
  // Four streams by turns, 256 bytes each; their buffers begin in one bank, or in four.
  const auto streams = [](std::uint64_t stagger) {
    Trace trace;
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const std::uint64_t stream = i % 4;
      for (std::uint64_t part = 0; part < 4; ++part) {
        trace.push_back({0, stream == 3, (stream << 24) + stream * stagger + i / 4 * 256 + part * 64, 64});
      }
    }
    return trace;
  };
  const std::int64_t apart = run(streams(2 * 4096)).clocks;
  const std::int64_t together = run(streams(0)).clocks;
  EXPECT_GT(together, apart * 11 / 10);
}

TEST(DramReplay, AnyMixEnds) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    Trace trace;
    unsigned state = seed * 7919 + 1;
    const auto draw = [&state](unsigned below) {
      return (state = state * 1664525u + 1013904223u) / 65536 % below;
    };
    double time = 0;
    std::uint64_t bytes = 0;
    for (int i = 0; i < 500; ++i) {
      if (seed % 3 == 0) time += draw(100);
      trace.push_back(
          {time, draw(100) < seed * 5 % 101, std::uint64_t{draw(1 << 12)} << (seed % 10), 1 + draw(300)});
      bytes += trace.back().bytes;
    }
    const auto mapping = seed % 2 == 0 ? DramMapping::kRowBankColumn : DramMapping::kBankRowColumn;
    const ReplayResult result = replay(trace, {}, {}, mapping, 1 + seed % 5 * 8);
    EXPECT_GE(result.bytes, bytes);
    EXPECT_LE(static_cast<std::int64_t>(result.bytes), result.clocks * 8);  // never more than the peak
  }
}

}  // namespace dram_replay_test
}  // namespace parallax::test
