// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/timing/in_child.hpp"
#include "tests/tlm/dma_bench.hpp"
#include "tests/tlm/random_memory.hpp"
#include "tlm/dma.hpp"

namespace parallax::test {
namespace dma_writer_test {

TEST(DmaWriter, ABurstLeavesTheFifoWhenTheMemoryTakesIt) {
  BusMemory t = plain_memory();
  t.queue_depth = 1;
  WriterBench<BusMemoryTarget> b(engine(32, 8, 8), {}, 4, t, memory_clock());
  Cycles done;
  b.writer.start({0, {128}, false, [&] { done = b.clock.now(); }});
  sc_core::sc_start();
  // Readable in 1, 2, 3, 4; the bus takes four cycles a burst: service in 1, 5, 9, 13. The third request is
  // taken when the second is served.
  EXPECT_EQ(b.dates.read, Dates({1, 2, 5, 9}));
  EXPECT_EQ(done.count(), 13 + 4 + 3);
  EXPECT_EQ(b.memory.statistics(0).written_bytes, 128u);
}

TEST(DmaWriter, CountsTheCyclesThatLackOfATokenCosts) {
  WriterBench<BusMemoryTarget> b(engine(32, 8, 8), {}, 2, plain_memory(), memory_clock());
  b.writer.start({0, {64}, false, nullptr});
  sc_core::sc_start();
  EXPECT_EQ(b.dates.read, Dates({1, 2}));
  EXPECT_EQ(b.stream.statistics().starved_on_empty.count(), 1);
}

TEST(DmaWriter, PutsTheBytesOfSeveralJobsInPlace) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const std::string text = in_child([seed] {
      const Values values = pattern(133 + 64);
      WriterBench<RandomMemory> b(engine(32, 1 + seed % 4, 4), values, 5 + 2, 4096u, seed, 70);
      int done = 0;
      b.writer.start({500, {100, 33}, true, [&] { ++done; }});
      b.writer.start({9, {}, true, [&] { ++done; }});
      b.writer.start({2000, {64}, true, [&] { ++done; }});
      sc_core::sc_start();
      Values expected(4096);
      std::copy(values.begin(), values.begin() + 133, expected.begin() + 500);
      std::copy(values.begin() + 133, values.end(), expected.begin() + 2000);
      std::string found;
      if (b.memory.bytes != expected) found += "values\n";
      if (done != 3) found += "not all jobs ended\n";
      if (b.memory.most_in_flight > 1 + seed % 4) found += "too many in flight\n";
      return found;
    });
    EXPECT_EQ(text, "") << "seed " << seed;
  }
}

TEST(DmaWriter, ReportsABurstWithoutItsBytes) {
  WriterBench<BusMemoryTarget> b(engine(32, 8, 8), Values(31), 1, plain_memory(), memory_clock());
  b.writer.start({0, {32}, true, nullptr});
  try {
    sc_core::sc_start();
    FAIL();
  } catch (const sc_core::sc_report& report) {
    EXPECT_STREQ(report.get_msg_type(), "/parallax/dma/values");
  }
}

// A burst keeps its date, and its bytes come to the memory when they are there.
TEST(DmaWriter, TakesBytesAfterTheirDateWhereItIsTold) {
  const auto run = [](std::size_t late, bool told) {
    return in_child([=] {
      const Values values = pattern(120);
      WriterBench<RandomMemory> b(engine(32, 2, 4), values, 4, 4096u, 7u, 70);
      b.source.late = late;
      DmaJob job{64, {120}, true, nullptr};
      job.late_values = told;
      b.writer.start(job);
      try {
        sc_core::sc_start();
      } catch (const sc_core::sc_report& report) {
        return std::string(report.get_msg_type());
      }
      Values expected(4096);
      std::copy(values.begin(), values.end(), expected.begin() + 64);
      std::string found = b.memory.bytes == expected ? "" : "values\n";
      for (const auto date : b.dates.read) found += std::to_string(date) + " ";
      return found;
    });
  };
  const std::string in_time = run(0, false);
  EXPECT_EQ(run(0, true), in_time);
  EXPECT_EQ(run(1, true), in_time) << "the last burst's";
  EXPECT_EQ(run(100, true), in_time);
  EXPECT_EQ(run(120, true), in_time);
  EXPECT_EQ(run(100, false), "/parallax/dma/values");
}

TEST(BurstCount, RoundsUp) {
  EXPECT_EQ(burst_count(0, Bytes(128)), 0u);
  EXPECT_EQ(burst_count(1, Bytes(128)), 1u);
  EXPECT_EQ(burst_count(128, Bytes(128)), 1u);
  EXPECT_EQ(burst_count(129, Bytes(128)), 2u);
}

}  // namespace dma_writer_test
}  // namespace parallax::test
