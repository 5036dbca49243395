// SPDX-License-Identifier: Apache-2.0
// The contract of a stream, as a data sheet reads.
#include "tlm/stream.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/timing/date_log.hpp"
#include "tests/tlm/thread.hpp"
#include "tlm/error.hpp"

namespace parallax::test {
namespace stream_test {

using Dates = std::vector<std::int64_t>;

// A stream between two threads, each of which does its next transfer not before the given cycles.
struct Channel {
  Channel(const FifoConfig& fifo, Dates write_from, Dates read_from, std::int64_t writer_hz = 100'000'000,
          std::int64_t reader_hz = 100'000'000)
      : writer_clock("writer", Hertz(writer_hz)),
        reader_clock("reader", Hertz(reader_hz)),
        dataflow("dataflow"),
        stream("stream", dataflow, writer_clock,
               writer_hz == reader_hz && fifo.kind != FifoKind::kAsynchronous ? writer_clock : reader_clock,
               fifo),
        log(dates),
        writing("writing",
                [this, from = std::move(write_from)] {
                  for (const std::int64_t cycle : from) {
                    writer_clock.wait_until(Cycles(cycle));
                    stream.write(static_cast<int>(stream.statistics().written));
                  }
                }),
        reading("reading", [this, from = std::move(read_from)] {
          for (const std::int64_t cycle : from) {
            reader_clock.wait_until(Cycles(cycle));
            values.push_back(stream.read());
          }
        }) {
    stream.add_listener(log);
    sc_core::sc_start();
  }
  ClockDomain writer_clock, reader_clock;
  Dataflow dataflow;
  Stream<int> stream;
  EdgeDates dates;
  DateLog log;
  std::vector<int> values;
  Thread writing, reading;
};

FifoConfig fifo(std::uint32_t depth, std::uint32_t write_to_read = 1, std::uint32_t read_to_write = 1) {
  return {depth, Bits(8), write_to_read, read_to_write};
}

FifoConfig of_kind(FifoKind kind, std::uint32_t depth, std::uint32_t synchroniser_stages = 2) {
  FifoConfig config;
  config.depth = depth;
  config.kind = kind;
  config.synchroniser_stages = {synchroniser_stages, synchroniser_stages};
  return config;
}

Dates counting(std::int64_t from, std::size_t count, std::int64_t step = 1) {
  Dates dates;
  for (std::size_t i = 0; i < count; ++i) dates.push_back(from + static_cast<std::int64_t>(i) * step);
  return dates;
}

TEST(Stream, ReadableOneCycleAfterTheWrite) {
  Channel c(fifo(4), {10}, {0});
  EXPECT_EQ(c.dates.written, Dates({10}));
  EXPECT_EQ(c.dates.read, Dates({11}));
}

TEST(Stream, NotReadableAtNMinusOneButAtN) {
  const ClockDomain clock("clock", Hertz(100'000'000));
  Dataflow dataflow("dataflow");
  Stream<int> stream("stream", dataflow, clock, clock, fifo(4, 5));
  int checked = 0;
  Thread writing("writing", [&] {
    clock.wait_until(Cycles(10));
    stream.write(1);
  });
  Thread reading("reading", [&] {
    clock.wait_until(Cycles(10 + 5 - 1));
    EXPECT_TRUE(stream.read_date_known());
    EXPECT_GT(stream.readable_at(), clock.now());
    clock.wait_until(Cycles(10 + 5));
    EXPECT_EQ(stream.readable_at(), clock.now());
    ++checked;
  });
  sc_core::sc_start();
  EXPECT_EQ(checked, 1);
}

TEST(Stream, ReadableWriteToReadCyclesLater) {
  Channel c(fifo(4, 5), {10, 11}, {0, 0});
  EXPECT_EQ(c.dates.read, Dates({15, 16}));
}

TEST(Stream, WritableReadToWriteCyclesAfterTheReadDepthTokensBefore) {
  Channel c(fifo(3, 1, 4), {0, 0, 0, 0, 0}, {50, 60, 70, 70, 70});
  EXPECT_EQ(c.dates.written, Dates({0, 1, 2, 54, 64}));
  EXPECT_EQ(c.dates.read, Dates({50, 60, 70, 71, 72}));
}

TEST(Stream, OneTokenACycleAtDepthTwo) {
  Channel c(fifo(2), Dates(100, 0), Dates(100, 0));
  EXPECT_EQ(c.dates.written, counting(0, 100));
  EXPECT_EQ(c.dates.read, counting(1, 100));
}

TEST(Stream, HalfTheRateAtDepthOne) {
  Channel c(fifo(1), Dates(50, 0), Dates(50, 0));
  EXPECT_EQ(c.dates.written, counting(0, 50, 2));
  EXPECT_EQ(c.dates.read, counting(1, 50, 2));
}

TEST(Stream, DepthTokensARoundTrip) {  // 3 tokens in 2 + 4 cycles
  Channel c(fifo(3, 2, 4), Dates(9, 0), Dates(9, 0));
  EXPECT_EQ(c.dates.written, Dates({0, 1, 2, 6, 7, 8, 12, 13, 14}));
  EXPECT_EQ(c.dates.read, Dates({2, 3, 4, 8, 9, 10, 14, 15, 16}));
}

TEST(Stream, NeverTwoTokensACycle) {
  Channel c(fifo(8), {0, 0, 0}, {20, 20, 20});
  EXPECT_EQ(c.dates.written, Dates({0, 1, 2}));
  EXPECT_EQ(c.dates.read, Dates({20, 21, 22}));
}

// 100 MHz to 75 MHz: writer edges every 10 ns, reader edges every 13 1/3 ns.
TEST(Stream, CrossingToASlowerClock) {
  Channel c(fifo(8), {0, 2, 3, 4}, {0, 0, 0, 0}, 100'000'000, 75'000'000);
  // 0 ns -> edge 1; 20 ns -> edge 2 at 26.7 ns; 30 ns -> edge 3 at 40 ns; 40 ns is edge 3 itself -> edge 4.
  EXPECT_EQ(c.dates.read, Dates({1, 2, 3, 4}));
}

TEST(Stream, CrossingWithSynchroniserStages) {
  Channel c(fifo(1, 3, 2), {0, 0, 0}, {0, 0, 0}, 100'000'000, 75'000'000);
  // Read at 1 + 2 = edge 3, 40 ns; writable at the first edge after, 5, plus 1 = 6, 60 ns.
  // 60 ns -> edge 5 at 66.7 ns, + 2 = 7 at 93.3 ns; -> edge 10, + 1 = 11 at 110 ns; -> edge 9, + 2 = 11.
  EXPECT_EQ(c.dates.written, Dates({0, 6, 11}));
  EXPECT_EQ(c.dates.read, Dates({3, 7, 11}));
}

TEST(Stream, RegisteredIsOneAndOne) {
  Channel c(of_kind(FifoKind::kRegistered, 1), {10, 0}, {0, 0});
  EXPECT_EQ(c.dates.written, Dates({10, 12}));
  EXPECT_EQ(c.dates.read, Dates({11, 13}));
}

TEST(Stream, AWordFallsThroughInTheSameCycle) {
  Channel c(of_kind(FifoKind::kFirstWordFallThrough, 1), {10, 0, 0}, {0, 0, 20});
  EXPECT_EQ(c.dates.written, Dates({10, 11, 12}));
  EXPECT_EQ(c.dates.read, Dates({10, 11, 20}));
  EXPECT_EQ(c.values, std::vector<int>({0, 1, 2}));
}

TEST(Stream, ABlockRamTakesTwoCyclesToRead) {
  Channel c(of_kind(FifoKind::kBlockRam, 2), Dates(5, 0), Dates(5, 0));
  EXPECT_EQ(c.dates.written, Dates({0, 1, 3, 4, 6}));  // the token in the output register takes a slot
  EXPECT_EQ(c.dates.read, Dates({2, 3, 5, 6, 8}));
}

TEST(Stream, APlaceCanBeWrittenInTheCycleOfItsRead) {
  Channel c(fifo(1, 1, 0), Dates(4, 0), {0, 0, 9, 9});
  EXPECT_EQ(c.dates.written, Dates({0, 1, 2, 9}));
  EXPECT_EQ(c.dates.read, Dates({1, 2, 9, 10}));
  EXPECT_EQ(c.stream.statistics().high_water, 1u);
}

TEST(Stream, BothWaysInTheSameCycle) {
  Channel c(fifo(1, 0, 0), Dates(4, 0), {0, 0, 9, 9});
  EXPECT_EQ(c.dates.written, Dates({0, 1, 2, 9}));
  EXPECT_EQ(c.dates.read, Dates({0, 1, 9, 10}));
  EXPECT_EQ(c.stream.statistics().high_water, 1u);
}

TEST(Stream, WhatLeavesNoTraceIsNotHeld) {
  Channel c(fifo(1, 0, 0), Dates(4, 0), Dates(4, 0));
  EXPECT_EQ(c.dates.written, c.dates.read);
  EXPECT_EQ(c.stream.statistics().high_water, 0u);
}

// 100 MHz to 75 MHz, as above: the first reader edge after the write, and a register of two edges.
TEST(Stream, AnAsynchronousOneSynchronisesBothPointers) {
  Channel c(of_kind(FifoKind::kAsynchronous, 1, 2), {0, 0}, {0, 0}, 100'000'000, 75'000'000);
  // 0 ns -> edge 1, + 2 = 3, 40 ns -> edge 5, + 2 = 7, 70 ns -> edge 6 at 80 ns, + 2 = 8.
  EXPECT_EQ(c.dates.written, Dates({0, 7}));
  EXPECT_EQ(c.dates.read, Dates({3, 8}));
}

TEST(Stream, ClocksOfOneFrequencyAreSynchronisedToo) {
  Channel c(of_kind(FifoKind::kAsynchronous, 1, 2), {0, 0}, {0, 0});
  EXPECT_EQ(c.dates.written, Dates({0, 6}));
  EXPECT_EQ(c.dates.read, Dates({3, 9}));
}

TEST(Stream, StatisticsOfAFullStream) {
  Channel c(fifo(2), {0, 0, 0, 0}, {10, 0, 0, 0});
  // Token 2 is wanted in cycle 2 and written in cycle 11, when the slot that was freed in 10 can be written.
  EXPECT_EQ(c.dates.written, Dates({0, 1, 11, 12}));
  const StreamStatistics& s = c.stream.statistics();
  EXPECT_EQ(s.blocked_on_full.count(), 9);
  EXPECT_EQ(s.starved_on_empty.count(), 0);
  EXPECT_EQ(s.high_water, 2u);
  EXPECT_EQ(s.written, 4u);
  EXPECT_EQ(s.read, 4u);
}

TEST(Stream, StatisticsOfAnEmptyStream) {
  Channel c(fifo(4), {5, 20}, {0, 0});
  // Waited for from 0 to 6, and from 7 to 21.
  const StreamStatistics& s = c.stream.statistics();
  EXPECT_EQ(s.starved_on_empty.count(), 6 + 14);
  EXPECT_EQ(s.blocked_on_full.count(), 0);
  EXPECT_EQ(s.high_water, 1u);
}

TEST(Stream, HighWaterCountsATokenUntilItsPlaceIsFree) {
  Channel c(fifo(8), {0, 0, 0, 0, 0}, {3, 3, 3, 3, 3});
  // Written in 0..4, read in 3..7, free in 4..8: after cycle 3 there are 4, after cycle 4 five less one.
  EXPECT_EQ(c.stream.statistics().high_water, 4u);
}

TEST(Stream, ValuesArriveInOrder) {
  Channel c(fifo(2), Dates(10, 0), Dates(10, 0));
  EXPECT_EQ(c.values, std::vector<int>({0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST(Stream, PlacesAheadCanBeReserved) {
  const ClockDomain clock("clock", Hertz(100'000'000));
  Dataflow dataflow("dataflow");
  Stream<int> stream("stream", dataflow, clock, clock, fifo(3));
  Dates reserved;
  Thread writing("writing", [&] {
    for (std::uint64_t ahead = 0; ahead < 4; ++ahead) {
      stream.wait_writable(ahead);  // the fourth slot is token 0's
      reserved.push_back(clock.now().count());
      if (ahead == 2) stream.write(1);
      if (ahead == 2) stream.wait_writable(2);
    }
  });
  Thread reading("reading", [&] {
    clock.wait_until(Cycles(30));
    stream.read();
  });
  sc_core::sc_start(sc_core::sc_time(1, sc_core::SC_US));
  EXPECT_EQ(reserved, Dates({0, 0, 0}));
  EXPECT_EQ(clock.now().count(), 100);
  EXPECT_TRUE(stream.writer_waits());  // for the read of token 1
}

TEST(Stream, AReservedPlaceStaysTheSameWhileTokensBeforeItAreWritten) {
  const ClockDomain clock("clock", Hertz(100'000'000));
  Dataflow dataflow("dataflow");
  Stream<int> stream("stream", dataflow, clock, clock, fifo(1));
  std::int64_t reserved = -1;
  Thread reserving("reserving", [&] {
    stream.wait_writable(1);  // token 1, whose slot is token 0's
    reserved = clock.now().count();
  });
  Thread writing("writing", [&] {
    clock.wait_until(Cycles(10));
    stream.write(1);
  });
  Thread reading("reading", [&] {
    clock.wait_until(Cycles(30));
    stream.read();
  });
  sc_core::sc_start();
  EXPECT_EQ(reserved, 31);
}

TEST(Stream, CommitInTheFutureKeepsTheOrder) {
  const ClockDomain clock("clock", Hertz(100'000'000));
  Dataflow dataflow("dataflow");
  Stream<int> stream("stream", dataflow, clock, clock, fifo(4));
  EdgeDates dates;
  DateLog log(dates);
  stream.add_listener(log);
  Thread writing("writing", [&] {
    stream.commit(sc_core::sc_time(71, sc_core::SC_NS));  // between two edges: the later one
    stream.commit(sc_core::sc_time(80, sc_core::SC_NS));
    stream.commit();
  });
  sc_core::sc_start();
  EXPECT_EQ(dates.written, Dates({8, 9, 10}));
}

struct Rows {
  explicit Rows(std::size_t length) : clock("clock", Hertz(1'000'000)), dataflow("dataflow") {
    stream = std::make_unique<Stream<int>>("stream", dataflow, clock, clock, fifo(64));
    stream->on_row(length, [this](const int* row, std::size_t n) { rows.emplace_back(row, row + n); });
  }
  ClockDomain clock;
  Dataflow dataflow;
  std::unique_ptr<Stream<int>> stream;
  std::vector<std::vector<int>> rows;
};

TEST(Stream, CollectsRowsFromSingleTokens) {
  Rows r(3);
  Thread writing("writing", [&] {
    for (int i = 1; i <= 7; ++i) r.stream->write(i);
  });
  sc_core::sc_start();
  EXPECT_EQ(r.rows, (std::vector<std::vector<int>>{{1, 2, 3}, {4, 5, 6}}));
}

TEST(Stream, CollectsRowsFromPiecesOfAnyLength) {
  Rows r(4);
  const std::vector<int> values{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13};
  r.stream->send_row(values.data(), 1);
  r.stream->send_row(values.data() + 1, 6);
  r.stream->send_row(values.data() + 7, 1);
  r.stream->send_row(values.data() + 8, 4);
  r.stream->send_row(values.data() + 12, 1);
  EXPECT_EQ(r.rows, (std::vector<std::vector<int>>{{1, 2, 3, 4}, {5, 6, 7, 8}, {9, 10, 11, 12}}));
}

TEST(Stream, PassesRowsOnAsTheyAreSent) {
  Rows r(0);
  const std::vector<int> values{1, 2, 3, 4, 5};
  r.stream->send_row(values.data(), 2);
  r.stream->send_row(values.data() + 2, 3);
  EXPECT_EQ(r.rows, (std::vector<std::vector<int>>{{1, 2}, {3, 4, 5}}));
}

std::string refusal(const FifoConfig& config) {
  const ClockDomain clock("clock", Hertz(1));
  Dataflow dataflow("dataflow");
  try {
    Stream<int> stream("pixels", dataflow, clock, clock, config);
  } catch (const UserError& e) {
    return e.what();
  }
  return "";
}

TEST(Stream, RefusesADepthOfNothing) {
  EXPECT_EQ(refusal(fifo(0)), "stream 'pixels': depth 0 is outside 1 to 16777216 tokens");
}
TEST(Stream, RefusesADepthBeyondAllMemory) {
  EXPECT_EQ(refusal(fifo((1u << 24) + 1)), "stream 'pixels': depth 16777217 is outside 1 to 16777216 tokens");
}
TEST(Stream, RefusesOffsetsForAKindThatHasItsOwn) {
  FifoConfig config = of_kind(FifoKind::kBlockRam, 4);
  config.write_to_read = 3;
  EXPECT_EQ(refusal(config),
            "stream 'pixels': a FIFO of kind block_ram has offsets of its own, none can be given");
}
TEST(Stream, RefusesSynchronisersWithoutOrWithTooManyRegisters) {
  EXPECT_EQ(refusal(of_kind(FifoKind::kAsynchronous, 4, 0)),
            "stream 'pixels': 0 synchroniser stages are outside 1 to 63");
  EXPECT_EQ(refusal(of_kind(FifoKind::kAsynchronous, 4, 64)),
            "stream 'pixels': 64 synchroniser stages are outside 1 to 63");
  EXPECT_EQ(refusal(of_kind(FifoKind::kAsynchronous, 4, 63)), "");
}

TEST(Stream, TakesNothingBeforeItIsReady) {
  const ClockDomain clock("clock", Hertz(1));
  Dataflow dataflow("dataflow");
  FifoConfig config = fifo(2);
  config.not_ready_cycles = 3;
  Stream<int> stream("pixels", dataflow, clock, clock, config);
  EXPECT_EQ(stream.writable_at(0), Cycles(3));
  EXPECT_EQ(stream.writable_at(1), Cycles(3));
  stream.mark_written(Cycles(5), Cycles(0));
  EXPECT_EQ(stream.writable_at(), Cycles(3));
  stream.mark_written(Cycles(6), Cycles(0));
  stream.mark_read(Cycles(9), Cycles(0));
  EXPECT_EQ(stream.writable_at(), Cycles(10));
}

// Equal frequencies do not make one clock of two.
std::string refusal_between_clocks(const FifoConfig& config) {
  const ClockDomain core("core", Hertz(1));
  const ClockDomain link("link", Hertz(1));
  Dataflow dataflow("dataflow");
  try {
    Stream<int> stream("pixels", dataflow, core, link, config);
  } catch (const UserError& e) {
    return e.what();
  }
  return "";
}
TEST(Stream, RefusesASynchronousKindBetweenClocks) {
  for (const FifoKind kind : {FifoKind::kRegistered, FifoKind::kFirstWordFallThrough, FifoKind::kBlockRam}) {
    EXPECT_EQ(refusal_between_clocks(of_kind(kind, 4)),
              std::string("stream 'pixels': a FIFO of kind ") + name_of(kind) +
                  " cannot stand between the clocks 'core' and 'link'; an asynchronous one can");
  }
}
TEST(Stream, TakesAnAsynchronousOneAndOffsetsBetweenClocks) {
  EXPECT_EQ(refusal_between_clocks(of_kind(FifoKind::kAsynchronous, 4)), "");
  EXPECT_EQ(refusal_between_clocks(fifo(4, 3, 1)), "");
}
TEST(Stream, RefusesAnOffsetOfNothingBetweenClocksToRead) {
  EXPECT_EQ(refusal_between_clocks(fifo(4, 0, 1)),
            "stream 'pixels': an offset of 0 cycles cannot be kept between the clocks 'core' and 'link'");
}
TEST(Stream, RefusesAnOffsetOfNothingBetweenClocksToWrite) {
  EXPECT_EQ(refusal_between_clocks(fifo(4, 1, 0)),
            "stream 'pixels': an offset of 0 cycles cannot be kept between the clocks 'core' and 'link'");
}

}  // namespace stream_test
}  // namespace parallax::test
