// SPDX-License-Identifier: Apache-2.0
// Each handshake of a circuit at pins, against a naive loop over cycles.
#include <gtest/gtest.h>

#include <array>
#include <numeric>

#include "tests/timing/in_child.hpp"
#include "tests/tlm/pin_bench.hpp"
#include "tests/tlm/pin_circuits.hpp"

namespace parallax::test {
namespace pin_handshakes_test {

using Bench = PinBench<int, int>;
constexpr std::size_t kTokens = 60;

std::vector<int> numbers(std::size_t count = kTokens) {
  std::vector<int> all(count);
  std::iota(all.begin(), all.end(), 1);
  return all;
}

/// The registered FIFO before a circuit, and the one behind it with its reader, cycle by cycle.
struct NaiveStreams {
  NaiveStreams(const PinTimes& given, std::size_t out_depth) : times(given), depth(out_depth) {}

  bool is_there(std::int64_t cycle, std::size_t tokens = 1) const {
    const std::size_t last = read.size() + tokens - 1;
    return last < times.written.size() && times.written[last] + 1 <= cycle;
  }
  bool has_room(std::int64_t cycle, std::size_t tokens = 1) const {
    std::size_t held = written.size();
    for (const std::int64_t date : taken) held -= date + 1 <= cycle ? 1 : 0;
    return held + tokens <= depth;
  }
  /// The reader's turn, at the end of each cycle.
  void end_of(std::int64_t cycle) {
    const std::size_t next = taken.size();
    if (next < written.size() && written[next] + 1 <= cycle && times.wanted[next] <= cycle)
      taken.push_back(cycle);
  }
  bool done() const { return taken.size() == times.wanted.size(); }

  const PinTimes times;
  const std::size_t depth;
  Dates read, written, taken;
};

// In a child, as a test has several simulations; what differs, or nothing.
std::string difference(const Bench& bench, const NaiveStreams& naive, const std::vector<int>& values) {
  std::string text;
  if (bench.in_dates.read != naive.read) text += "the circuit reads at other dates\n";
  if (bench.out_dates.written != naive.written) text += "the circuit writes at other dates\n";
  if (bench.values != values) text += "the values differ\n";
  return text;
}

// Three registers whose clock stands where a result has no room, with and without the pin for it.
NaiveStreams three_registers(const PinTimes& times, std::size_t depth, std::int64_t interval) {
  NaiveStreams naive(times, depth);
  std::array<bool, 3> full{};
  std::int64_t next = 0;
  for (std::int64_t cycle = 0; !naive.done(); ++cycle) {
    if (!full[2] || naive.has_room(cycle)) {
      if (full[2]) naive.written.push_back(cycle);
      const bool takes = naive.is_there(cycle) && cycle >= next;
      if (takes) {
        naive.read.push_back(cycle);
        next = cycle + interval;
      }
      full = {takes, full[0], full[1]};
    }
    naive.end_of(cycle);
  }
  return naive;
}

struct ValidAlone {
  ValidAlone(Bench& bench, const PinConfig& config, bool has_enable)
      : clock("clock", bench.clock),
        source("source", clock, config),
        sink("sink", clock),
        circuit("circuit") {
    clock.clock(clk);
    clock.reset(rst);
    circuit.clk(clk);
    circuit.rst(rst);
    if (has_enable) {  // a pixel strobe: 0 at an edge at which nothing may move
      clock.enable(ce);
    } else {
      ce = true;
    }
    circuit.ce(ce);
    source.in(bench.in);
    source.valid(in_valid);
    source.data(in_data);
    circuit.in_valid(in_valid);
    circuit.in_data(in_data);
    sink.out(bench.out);
    sink.valid(out_valid);
    sink.data(out_data);
    circuit.out_valid(out_valid);
    circuit.out_data(out_data);
  }
  sc_core::sc_signal<bool> clk, rst, ce, in_valid, out_valid;
  sc_core::sc_signal<std::uint32_t> in_data, out_data;
  PinClock clock;
  PinSource<int, std::uint32_t> source;
  PinSink<int, std::uint32_t> sink;
  PassThree circuit;
};

TEST(PinHandshakes, WithValidAloneTheClockStandsWhereThereIsNoRoom) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const bool has_enable : {false, true}) {
      for (const std::int64_t interval : {1, 4}) {
        ASSERT_EQ(in_child([&] {
                    const PinTimes times = drawn_times(kTokens, seed);
                    Bench bench(numbers(), times, 2);
                    PinConfig config;
                    config.interval = static_cast<std::uint64_t>(interval);
                    ValidAlone pins(bench, config, has_enable);
                    bench.run();
                    std::vector<int> values = numbers();
                    for (int& value : values) ++value;
                    return difference(bench, three_registers(times, 2, interval), values);
                  }),
                  "")
            << "seed " << seed << " enable " << has_enable << " interval " << interval;
      }
    }
  }
}

// A token at each edge, and its result a register later; rows of ten, each sum of a window about its token.
constexpr std::size_t kRow = 10;
constexpr std::size_t kFlush = 2;

NaiveStreams one_register(const PinTimes& times, std::size_t depth) {
  NaiveStreams naive(times, depth);
  std::size_t step = 0;  // of the row: its tokens, and those behind it
  for (std::int64_t cycle = 0; !naive.done(); ++cycle) {
    const bool result = step >= 2 && step < 2 + kRow;  // the first step has none, and its own sum is dropped
    if ((step >= kRow || naive.is_there(cycle)) && (!result || naive.has_room(cycle))) {
      if (result) naive.written.push_back(cycle);
      if (step < kRow) naive.read.push_back(cycle);
      step = (step + 1) % (kRow + kFlush);
    }
    naive.end_of(cycle);
  }
  return naive;
}

struct FreeRunning {
  explicit FreeRunning(Bench& bench)
      : clock("clock", bench.clock),
        source("source", clock, rows()),
        sink("sink", clock, rows()),
        circuit("circuit") {
    clock.clock(clk);
    circuit.clk(clk);
    source.in(bench.in);
    source.data(in_data);
    circuit.in_data(in_data);
    sink.out(bench.out);
    sink.data(out_data);
    circuit.out_data(out_data);
  }
  static PinConfig rows() {
    PinConfig config;
    config.frame_tokens = kRow;
    config.latency = 1;  // edges from a token to its result
    config.flush = 2;    // behind the row: one for its last window, one for that to get out of the register
    config.skip = 1;     // the first result is of a window that lies before the row
    return config;
  }
  sc_core::sc_signal<bool> clk;
  sc_core::sc_signal<std::uint32_t> in_data, out_data;
  PinClock clock;
  PinSource<int, std::uint32_t> source;
  PinSink<int, std::uint32_t> sink;
  SumOfThree circuit;
};

TEST(PinHandshakes, FreeRunningATokenGoesInAtEachEdge) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    ASSERT_EQ(in_child([&] {
                const PinTimes times = drawn_times(kTokens, seed);
                Bench bench(numbers(), times, 3);
                FreeRunning pins(bench);
                bench.run();
                const std::vector<int> in = numbers();
                std::vector<int> values;
                for (std::size_t i = 0; i < in.size(); ++i) {
                  const std::size_t at = i % kRow;
                  values.push_back((at > 0 ? in[i - 1] : 0) + in[i] + (at + 1 < kRow ? in[i + 1] : 0));
                }
                return difference(bench, one_register(times, 3), values);
              }),
              "")
        << "seed " << seed;
  }
}

struct Gates {
  explicit Gates(Bench& bench)
      : clock("clock", bench.clock), source("source", clock), sink("sink", clock), circuit("circuit") {
    source.in(bench.in);
    source.data(in_data);
    circuit.in_data(in_data);
    sink.out(bench.out);
    sink.data(out_data);
    circuit.out_data(out_data);
  }
  sc_core::sc_signal<std::uint32_t> in_data, out_data;
  PinClock clock;  // no pin: it says when tokens pass
  PinSource<int, std::uint32_t> source;
  PinSink<int, std::uint32_t> sink;
  Complement circuit;
};

TEST(PinHandshakes, ACombinationalCircuitAnswersInTheCycle) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    ASSERT_EQ(in_child([&] {
                const PinTimes times = drawn_times(kTokens, seed);
                Bench bench(numbers(), times, 2);
                Gates pins(bench);
                bench.run();
                NaiveStreams naive(times, 2);
                for (std::int64_t cycle = 0; !naive.done(); ++cycle) {
                  if (naive.is_there(cycle) && naive.has_room(cycle)) {
                    naive.read.push_back(cycle);
                    naive.written.push_back(cycle);
                  }
                  naive.end_of(cycle);
                }
                std::vector<int> values = numbers();
                for (int& value : values) value = 255 - value;
                return difference(bench, naive, values);
              }),
              "")
        << "seed " << seed;
  }
}

struct Bursts {
  explicit Bursts(Bench& bench)
      : clock("clock", bench.clock),
        source("source", clock, of_four()),
        sink("sink", clock, of_four()),
        circuit("circuit") {
    clock.clock(clk);
    clock.reset(rst);
    circuit.clk(clk);
    circuit.rst(rst);
    source.in(bench.in);
    source.bind(in);
    circuit.in_valid(in.valid);
    circuit.in_ready(in.ready);
    circuit.in_data(in.data);
    sink.out(bench.out);
    sink.bind(out);
    circuit.out_valid(out.valid);
    circuit.out_ready(out.ready);
    circuit.out_data(out.data);
  }
  static PinConfig of_four() {
    PinConfig config;
    config.burst = 4;
    return config;
  }
  sc_core::sc_signal<bool> clk, rst;
  PinSignals<std::uint32_t> in, out;
  PinClock clock;
  PinSource<int, std::uint32_t> source;
  PinSink<int, std::uint32_t> sink;
  TurnFour circuit;
};

TEST(PinHandshakes, ABurstBeginsWhenAllOfItIsThereOrHasRoom) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    ASSERT_EQ(in_child([&] {
                const PinTimes times = drawn_times(kTokens, seed);
                Bench bench(numbers(), times, 6);
                Bursts pins(bench);
                bench.run();
                NaiveStreams naive(times, 6);
                std::vector<std::size_t> held;
                bool fills = true;
                std::size_t left_in = 0, left_out = 0;
                for (std::int64_t cycle = 0; !naive.done(); ++cycle) {
                  if (!fills && left_out == 0 && naive.has_room(cycle, 4)) left_out = 4;
                  if (fills) {
                    if (left_in == 0 && naive.is_there(cycle, 4)) left_in = 4;
                    if (left_in > 0) {
                      naive.read.push_back(cycle);
                      fills = --left_in > 0;
                    }
                  } else if (left_out > 0) {
                    naive.written.push_back(cycle);
                    fills = --left_out == 0;
                  }
                  naive.end_of(cycle);
                }
                std::vector<int> values = numbers();
                for (std::size_t i = 0; i < values.size(); i += 4)
                  std::reverse(values.begin() + static_cast<std::ptrdiff_t>(i),
                               values.begin() + static_cast<std::ptrdiff_t>(i + 4));
                return difference(bench, naive, values);
              }),
              "")
        << "seed " << seed;
  }
}

}  // namespace pin_handshakes_test
}  // namespace parallax::test
