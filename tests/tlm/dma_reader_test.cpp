// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <tlm_utils/simple_target_socket.h>

#include <algorithm>
#include <memory>

#include "tests/timing/in_child.hpp"
#include "tests/tlm/dma_bench.hpp"
#include "tests/tlm/random_memory.hpp"
#include "tests/tlm/thread.hpp"
#include "tlm/dma.hpp"

namespace parallax::test {
namespace dma_reader_test {

/// Answers at once, and notes the addresses.
class RecordedMemory final : public sc_core::sc_module {
 public:
  using Log = std::vector<std::uint64_t>;
  tlm_utils::simple_target_socket<RecordedMemory> socket{"socket"};
  RecordedMemory(const sc_core::sc_module_name& name, Log& log) : sc_module(name), log_(log) {
    socket.register_b_transport(this, &RecordedMemory::b_transport);
  }

 private:
  void b_transport(::tlm::tlm_generic_payload& payload, sc_core::sc_time&) {
    log_.push_back(payload.get_address());
    payload.set_response_status(::tlm::TLM_OK_RESPONSE);
  }
  Log& log_;
};

TEST(DmaReader, DatesByHand) {
  // Requests in cycles 0, 1, 2, 3; a burst is two cycles on the bus, then three of latency. The fifth request
  // waits for the first answer.
  ReaderBench<BusMemoryTarget> b(engine(16, 4, 8), 6, 0, plain_memory(), memory_clock());
  b.reader.start({0, {96}, false, nullptr});
  sc_core::sc_start();
  EXPECT_EQ(b.dates.written, Dates({5, 7, 9, 11, 13, 15}));
  EXPECT_EQ(b.dates.read, Dates({6, 8, 10, 12, 14, 16}));
}

TEST(DmaReader, OneOutstandingRequestWaitsOutEachLatency) {
  ReaderBench<BusMemoryTarget> b(engine(16, 1, 8), 4, 0, plain_memory(), memory_clock());
  b.reader.start({0, {64}, false, nullptr});
  sc_core::sc_start();
  EXPECT_EQ(b.dates.written, Dates({5, 10, 15, 20}));
}

TEST(DmaReader, IsOccupiedWhileRequestsAreUnderWay) {
  ReaderBench<BusMemoryTarget> b(engine(16, 4, 8), 6, 0, plain_memory(), memory_clock());
  b.reader.start({0, {96}, false, nullptr});
  const std::vector<std::int64_t> requested{0, 1, 2, 3, 5, 7};
  const std::vector<std::int64_t> answered{5, 7, 9, 11, 13, 15};
  Thread sampling("sampling", [&] {
    for (std::int64_t half = 1; half < 40; ++half) {
      sc_core::wait(sc_core::sc_time(5, sc_core::SC_NS));
      std::int64_t halves = 0;
      for (std::size_t i = 0; i < requested.size(); ++i) {
        halves += std::clamp(half, 2 * requested[i], 2 * answered[i]) - 2 * requested[i];
      }
      EXPECT_EQ(b.reader.master.occupied(),
                sc_core::sc_time(5.0 * static_cast<double>(halves), sc_core::SC_NS))
          << half << " half cycles";
    }
  });
  sc_core::sc_start();
}

TEST(DmaReader, EachJobIsDoneWithItsLastAnswer) {
  ReaderBench<BusMemoryTarget> b(engine(16, 4, 8), 4, 0, plain_memory(), memory_clock());
  Dates done;
  const auto note = [&] { done.push_back(b.clock.now().count()); };
  b.reader.start({0, {16}, false, note});
  b.reader.start({0, {32}, false, note});
  b.reader.start({0, {}, false, note});
  b.reader.start({0, {16}, false, note});
  sc_core::sc_start();
  EXPECT_EQ(b.dates.written, Dates({5, 7, 9, 11}));
  EXPECT_EQ(done, Dates({5, 9, 9, 11}));
}

TEST(DmaReader, AShortLastBurstTakesLessTime) {
  ReaderBench<BusMemoryTarget> b(engine(16, 1, 8), 2, 0, plain_memory(), memory_clock());
  b.reader.start({0, {17}, false, nullptr});
  sc_core::sc_start();
  EXPECT_EQ(b.dates.written, Dates({5, 9}));
  EXPECT_EQ(b.memory.statistics(0).read_bytes, 17u);
}

TEST(DmaReader, ReservesAPlaceInItsFifoForEachRequest) {
  // No token is read: two slots, two requests.
  ReaderBench<BusMemoryTarget> b(engine(16, 4, 2), 0, 0, plain_memory(), memory_clock());
  b.reader.start({0, {160}, false, nullptr});
  sc_core::sc_start();
  EXPECT_EQ(b.dates.written, Dates({5, 7}));
  EXPECT_EQ(b.memory.statistics(0).requests, 2u);
}

TEST(DmaReader, AsksForTheNextBurstWhenAPlaceIsFreed) {
  ReaderBench<BusMemoryTarget> b(engine(16, 4, 1), 3, 0, plain_memory(), memory_clock());
  b.reader.start({0, {48}, false, nullptr});
  sc_core::sc_start();
  // Read in 6, free and requested in 7, 5 cycles later there.
  EXPECT_EQ(b.dates.written, Dates({5, 12, 19}));
}

TEST(DmaReader, CountsTheCyclesThatLackOfRoomCosts) {
  ReaderBench<BusMemoryTarget> b(engine(16, 4, 1), 3, 0, plain_memory(), memory_clock());
  b.reader.start({0, {48}, false, nullptr});
  sc_core::sc_start();
  // It could ask again in 1 and in 8; there is room in 7 and in 14.
  EXPECT_EQ(b.stream.statistics().blocked_on_full.count(), 6 + 6);
}

TEST(DmaReader, BringsTheBytesOfSeveralJobs) {
  ReaderBench<BusMemoryTarget> b(engine(32, 4, 4), 4 + 2 + 1, 3, plain_memory(), memory_clock());
  const Values bytes = pattern(1 << 16);
  std::vector<std::string> done;
  Thread filling("filling", [&] {
    fill(b.reader.master, bytes);
    const auto note = [&](const char* name) { return [&done, name] { done.emplace_back(name); }; };
    b.reader.start({1000, {40, 1, 59}, true, note("first")});  // 100 bytes: 32 + 32 + 32 + 4
    b.reader.start({0, {}, true, note("empty")});
    b.reader.start({7, {33}, true, note("second")});
    b.reader.start({5000, {32}, true, note("third")});
  });
  sc_core::sc_start();
  Values expected(bytes.begin() + 1000, bytes.begin() + 1100);
  expected.insert(expected.end(), bytes.begin() + 7, bytes.begin() + 40);
  expected.insert(expected.end(), bytes.begin() + 5000, bytes.begin() + 5032);
  EXPECT_EQ(b.sink.values, expected);
  EXPECT_EQ(done, std::vector<std::string>({"first", "empty", "second", "third"}));
  EXPECT_EQ(b.dates.read.size(), 7u);
  EXPECT_EQ(b.reader.master.in_flight(), 0u);
}

TEST(DmaReader, RowsWithAPitchArePiecesOfTheirOwn) {
  ReaderBench<BusMemoryTarget> b(engine(32, 4, 4), 3 * 2 + 1, 0, plain_memory(), memory_clock());
  const Values bytes = pattern(1 << 16);
  Thread filling("filling", [&] {
    fill(b.reader.master, bytes);
    b.reader.start({1000, {40, 40, 40}, true, nullptr, 300});  // each 32 + 8
    b.reader.start({7, {32}, true, nullptr});
  });
  sc_core::sc_start();
  Values expected;
  for (const int begin : {1000, 1300, 1600}) {
    expected.insert(expected.end(), bytes.begin() + begin, bytes.begin() + begin + 40);
  }
  expected.insert(expected.end(), bytes.begin() + 7, bytes.begin() + 39);
  EXPECT_EQ(b.sink.values, expected);
  EXPECT_EQ(b.dates.read.size(), 7u);
  EXPECT_EQ(b.memory.statistics(0).read_bytes, 3u * 40 + 32);
}

TEST(DmaReader, DoesNotOvertakeTheWriterBehindWhichItGoes) {
  // Alone, it would request in cycles 0 to 3. The writer's answers come in 10, 20, 20 and 40; a burst takes
  // two cycles on the bus and three of latency.
  ReaderBench<BusMemoryTarget> b(engine(16, 4, 8), 4, 0, plain_memory(), memory_clock());
  const auto progress = std::make_shared<TransferProgress>(b.dataflow);
  DmaJob job{0, {64}, false, nullptr};
  job.behind = progress;
  job.needed = [](std::uint64_t last_byte) { return last_byte / 16; };
  b.reader.start(job);
  Thread writing("writing", [&] {
    progress->answered(b.clock.time_of(Cycles(10)));  // known ahead
    sc_core::wait(b.clock.time_of(Cycles(20)));
    progress->answered(sc_core::sc_time_stamp());
    progress->answered(sc_core::sc_time_stamp());
    progress->answered(b.clock.time_of(Cycles(40)));
  });
  sc_core::sc_start();
  EXPECT_EQ(b.dates.written, Dates({15, 25, 27, 45}));
}

TEST(DmaReader, WaitsForARowThatIsBeingWritten) {
  ReaderBench<BusMemoryTarget> b(engine(16, 4, 8), 4, 0, plain_memory(), memory_clock());
  const auto progress = std::make_shared<TransferProgress>(b.dataflow);
  const Values bytes = pattern(64);
  DmaJob job{0, {32, 32}, true, nullptr};
  job.behind = progress;
  job.needed = [](std::uint64_t last_byte) { return (last_byte + 31) / 32; };
  b.reader.start(job);
  Thread writing("writing", [&] {
    for (std::size_t row = 0; row < 2; ++row) {
      progress->answered(b.clock.time_of(Cycles(50 * static_cast<int>(row) + 50)));  // ahead of its bytes
      sc_core::wait(sc_core::sc_time(400, sc_core::SC_NS));
      fill(b.reader.master, Values(bytes.begin(), bytes.begin() + 32 * static_cast<int>(row + 1)));
      sc_core::wait(sc_core::sc_time(100, sc_core::SC_NS));
    }
  });
  sc_core::sc_start();
  EXPECT_EQ(b.dates.written, Dates({55, 57, 105, 107}));
  EXPECT_EQ(b.sink.values, bytes);
}

TEST(DmaReader, ReadsDownwards) {
  RecordedMemory::Log log;
  ReaderBench<RecordedMemory> b(engine(16, 1, 8), 3, 0, log);
  DmaJob job{256, {48}, false, nullptr};
  job.downwards = true;
  b.reader.start(job);
  sc_core::sc_start();
  EXPECT_EQ(log, RecordedMemory::Log({256 + 32, 256 + 16, 256}));
}

TEST(DmaReader, AnErrorOfTheMemoryIsReported) {
  ReaderBench<BusMemoryTarget> b(engine(16, 4, 8), 6, 0, plain_memory(), memory_clock());
  b.reader.start({(1 << 16) - 8, {16}, false, nullptr});
  try {
    sc_core::sc_start();
    FAIL();
  } catch (const sc_core::sc_report& report) {
    EXPECT_STREQ(report.get_msg_type(), "/parallax/dma/response");
    EXPECT_STREQ(report.get_msg(), "reader.master: 16 bytes at 0xfff8: TLM_ADDRESS_ERROR_RESPONSE");
  }
}

TEST(DmaReader, AnotherMemoryGivesTheSameValuesAtOtherTimes) {
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    const std::uint32_t outstanding = 1 + seed % 5;
    const std::uint32_t fifo_bursts = 1 + seed % 7;
    const std::string text = in_child([=] {
      ReaderBench<RandomMemory> b(engine(32, outstanding, fifo_bursts), 60, seed % 3 == 0 ? 4 : 0, 4096u,
                                  seed, 95);
      b.memory.bytes = pattern(4096);
      bool done = false;
      b.reader.start({100, std::vector<std::uint32_t>(19, 100), true, [&] { done = true; }});
      sc_core::sc_start();
      std::string found;
      if (b.sink.values != Values(b.memory.bytes.begin() + 100, b.memory.bytes.begin() + 2000))
        found += "values\n";
      if (!done || b.dates.read.size() != 60) found += "not all bursts arrived\n";
      if (b.memory.most_in_flight > std::min(outstanding, fifo_bursts)) found += "too many in flight\n";
      for (std::size_t i = 0; i < b.memory.requests.size(); ++i) {
        const Cycles cycle = b.clock.cycle_at_or_after(b.memory.requests[i]);
        if (b.clock.time_of(cycle) != b.memory.requests[i]) found += "a request between two edges\n";
        if (i > 0 && b.memory.requests[i] <= b.memory.requests[i - 1]) found += "two requests in a cycle\n";
      }
      return found;
    });
    EXPECT_EQ(text, "") << "seed " << seed;
  }
}

}  // namespace dma_reader_test
}  // namespace parallax::test
