// SPDX-License-Identifier: Apache-2.0
// What the ends of a circuit at pins put on them and take from them, and when.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <numeric>
#include <string>

#include "tests/timing/in_child.hpp"
#include "tests/tlm/pin_bench.hpp"

namespace parallax::test {
namespace pin_ends_test {

constexpr std::size_t kTokens = 24;
using Token = std::array<std::uint64_t, 17>;  // 1088 bits

/// From an AXI stream of 1088 bits to one of the same: wires, and what passes on the side.
struct WideWires {
  using Data = sc_dt::sc_bv<1088>;
  explicit WideWires(PinBench<Token, Token>& bench)
      : clock("clock", bench.clock),
        source("s_axis", clock, config(), pack),
        sink("m_axis", clock, {}, unpack),
        watching("watching", [this] { watch(); }) {
    clock.clock(aclk);
    clock.reset(aresetn);
    source.in(bench.in);
    source.data(tdata);
    source.valid(tvalid);
    source.ready(tready);
    source.last(tlast);
    source.first(tuser);
    source.row(row);
    source.column(column);
    sink.out(bench.out);
    sink.data(tdata);
    sink.valid(tvalid);
    sink.ready(tready);
  }
  static PinConfig config() {
    PinConfig config;
    config.row_tokens = 4;
    config.frame_tokens = 12;
    return config;
  }
  static Data pack(const Token& token) {
    Data bits;
    for (int i = 0; i < 17; ++i) bits.range(64 * i + 63, 64 * i) = token[static_cast<std::size_t>(i)];
    return bits;
  }
  static Token unpack(const Data& bits) {
    Token token;
    for (int i = 0; i < 17; ++i)
      token[static_cast<std::size_t>(i)] = bits.range(64 * i + 63, 64 * i).to_uint64();
    return token;
  }
  void watch() {
    for (;;) {
      sc_core::wait(aclk.posedge_event());
      if (!tvalid || !tready || sc_core::sc_time_stamp() < sc_core::sc_time(1, sc_core::SC_NS)) continue;
      side.push_back(std::to_string(row) + "," + std::to_string(column) + (tuser ? " first" : "") +
                     (tlast ? " last" : ""));
    }
  }
  sc_core::sc_signal<bool> aclk, aresetn, tvalid, tready, tlast, tuser;
  sc_core::sc_signal<Data> tdata;
  sc_core::sc_signal<std::uint32_t> row, column;
  PinClock clock;
  PinSource<Token, Data> source;
  PinSink<Token, Data> sink;
  std::vector<std::string> side;
  Thread watching;
};

TEST(PinEnds, DriveRowsAndFramesBesideAWideToken) {
  EXPECT_EQ(in_child([]() -> std::string {
              std::vector<Token> tokens(kTokens);
              for (std::size_t i = 0; i < kTokens; ++i)
                for (std::size_t word = 0; word < 17; ++word)
                  tokens[i][word] = (i + 1) * 0x9E3779B97F4A7C15u << word;
              PinBench<Token, Token> bench(tokens, drawn_times(kTokens, 3));
              WideWires wires(bench);
              bench.run();
              if (bench.values != tokens) return "the values differ";
              std::string text;
              for (const std::string& each : wires.side) text += each + "\n";
              return text;
            }),
            "0,0 first\n0,1\n0,2\n0,3 last\n1,0\n1,1\n1,2\n1,3 last\n2,0\n2,1\n2,2\n2,3 last\n"
            "0,0 first\n0,1\n0,2\n0,3 last\n1,0\n1,1\n1,2\n1,3 last\n2,0\n2,1\n2,2\n2,3 last\n");
}

template <class T, class Data, class Bit>
std::string through_wires(const std::vector<T>& tokens) {
  return in_child([&]() -> std::string {
    PinBench<T, T> bench(tokens, drawn_times(tokens.size(), 5));
    PinClock clock("clock", bench.clock);
    PinSignals<Data, Bit> pins;
    PinSource<T, Data, Bit> source("source", clock);
    PinSink<T, Data, Bit> sink("sink", clock, {},
                               [](const Data& bits) { return static_cast<T>(sc_dt::sc_uint<64>(bits)); });
    source.in(bench.in);
    source.bind(pins);
    sink.out(bench.out);
    sink.bind(pins);
    bench.run();
    return bench.values == tokens ? "" : "the values differ";
  });
}

TEST(PinEnds, TakeDataOfEachType) {
  std::vector<std::uint64_t> numbers;
  std::mt19937_64 random(1);
  for (std::size_t i = 0; i < kTokens; ++i) numbers.push_back(random());
  EXPECT_EQ((through_wires<std::uint64_t, std::uint64_t, bool>(numbers)), "");
  EXPECT_EQ((through_wires<std::uint64_t, sc_dt::sc_uint<64>, bool>(numbers)), "");
  EXPECT_EQ((through_wires<std::uint64_t, sc_dt::sc_bv<100>, bool>(numbers)), "");
  EXPECT_EQ((through_wires<std::uint64_t, sc_dt::sc_lv<70>, sc_dt::sc_logic>(numbers)), "");
  EXPECT_EQ((through_wires<std::uint8_t, bool, bool>({1, 0, 0, 1, 1})), "");
  EXPECT_EQ((through_wires<std::uint8_t, std::uint32_t, sc_dt::sc_logic>({1, 0, 255, 7})), "");
}

/// Wires between two streams.
struct Wires {
  Wires(PinBench<int, int>& bench, const PinConfig& from, const PinConfig& to,
        const PinClockConfig& clocking = {})
      : clock("clock", bench.clock, clocking), source("source", clock, from), sink("sink", clock, to) {
    source.in(bench.in);
    source.bind(pins);
    sink.out(bench.out);
    sink.bind(pins);
  }
  PinClock clock;
  PinSignals<std::uint32_t> pins;
  PinSource<int, std::uint32_t> source;
  PinSink<int, std::uint32_t> sink;
};

std::vector<int> numbers(std::size_t count) {
  std::vector<int> all(count);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

PinTimes at_once(std::size_t tokens) { return {Dates(tokens, 0), Dates(tokens, 0)}; }

// As text, since each run has a process of its own.
template <class Change>
std::string written_dates(const PinConfig& from, const PinConfig& to, const Change& change) {
  return in_child([&] {
    PinBench<int, int> bench(numbers(200), at_once(200), 200);
    Wires wires(bench, from, to);
    Thread changing("changing", [&] { change(bench, wires); });
    bench.run(100000);
    std::string text;
    for (const std::int64_t date : bench.out_dates.written) text += std::to_string(date) + " ";
    return bench.values == numbers(200) ? text : "the values differ";
  });
}

std::int64_t last_of(const std::string& dates) {
  return std::stoll(dates.substr(dates.rfind(' ', dates.size() - 2) + 1));
}

TEST(PinEnds, StallAtRandomAsTheSeedSays) {
  const auto nothing = [](auto&, auto&) {};
  PinConfig often;
  often.stall = 500;
  PinConfig other = often;
  other.seed = 2;
  const std::string freely = written_dates({}, {}, nothing);
  EXPECT_EQ(last_of(freely), 200);  // the stream before it is a register
  for (const bool at_source : {true, false}) {
    const auto run = [&](const PinConfig& config) {
      return at_source ? written_dates(config, {}, nothing) : written_dates({}, config, nothing);
    };
    const std::string stalled = run(often);
    EXPECT_GT(last_of(stalled), 350);
    EXPECT_LT(last_of(stalled), 450);
    EXPECT_EQ(run(often), stalled);
    EXPECT_NE(run(other), stalled);
  }
  // From cycle 100 on without.
  const std::string half = written_dates(often, often, [](auto& bench, auto& wires) {
    bench.clock.wait_until(Cycles(100));
    wires.source.stall(0);
    wires.sink.stall(0);
  });
  EXPECT_GT(last_of(half), 260);
  EXPECT_LT(last_of(half), 290);
}

TEST(PinEnds, AreNotReadyInTheFirstCycles) {
  PinConfig late;
  late.not_ready_cycles = 20;
  const auto nothing = [](auto&, auto&) {};
  EXPECT_EQ(written_dates(late, {}, nothing).substr(0, 6), "20 21 ");
  EXPECT_EQ(written_dates({}, late, nothing).substr(0, 6), "20 21 ");
}

TEST(PinEnds, CountWhatTheyWaitFor) {
  EXPECT_EQ(in_child([] {
              PinBench<int, int> bench(numbers(3), {{5, 6, 20}, {0, 0, 0}}, 1);
              Wires wires(bench, {}, {});
              bench.run();
              // Readable in 6, 7 and 21; a place is free two cycles after it was written. So a token is
              // wanted and not there from 0 to 5 and from 10 to 20.
              std::string text;
              for (const std::int64_t date : bench.out_dates.written) text += std::to_string(date) + " ";
              return text + std::to_string(bench.in.statistics().starved_on_empty.count()) + " " +
                     std::to_string(bench.out.statistics().blocked_on_full.count()) + " " +
                     std::to_string(wires.source.tokens()) + " " + std::to_string(wires.sink.tokens());
            }),
            "6 8 21 17 1 3 3");
}

// A stage reads in the cycle of the writing (tests/timing/pin_dates_test.cpp).
TEST(PinEnds, AreSeenACycleLaterByAThreadOverAnOffsetOfZero) {
  for (const std::uint32_t write_to_read : {0, 1}) {
    EXPECT_EQ(in_child([write_to_read] {
                PinBench<int, int> bench(numbers(3), {{4, 5, 9}, {0, 0, 0}}, 2, write_to_read);
                Wires wires(bench, {}, {});
                bench.run();
                std::string text;
                for (const std::int64_t date : bench.out_dates.read) text += std::to_string(date) + " ";
                return text;
              }),
              "6 7 11 ");  // written in 5, 6 and 10
  }
}

TEST(PinEnds, PassTokensWithoutValuesByTheirDates) {
  EXPECT_EQ(in_child([]() -> std::string {
              PinBench<int, int> bench({1, 2, 3, 4, 5, 6, 7, 8}, {Dates(20, 0), {}}, 20);
              PinConfig config;
              config.with_values = 8;
              Wires wires(bench, config, config);
              std::string text;
              bench.out.on_row(
                  1, [&text](const int* value, std::size_t) { text += std::to_string(*value) + " "; });
              bench.run();
              return text + std::to_string(bench.out_dates.written.size()) + " data " +
                     std::to_string(wires.pins.data.read());
            }),
            "1 2 3 4 5 6 7 8 20 data 0");
}

TEST(PinClock, ResetsBeforeCycleZero) {
  for (const bool low : {false, true}) {
    EXPECT_EQ(in_child([low] {
                const ClockDomain domain("domain", Hertz(100'000'000));
                PinClockConfig config;
                config.reset_cycles = 5;
                config.reset_is_low = low;
                PinClock clock("clock", domain, config);
                sc_core::sc_signal<bool> clk, rst;
                clock.clock(clk);
                clock.reset(rst);
                int in_reset = 0, behind = 0;
                std::vector<std::int64_t> rises;
                Thread watching("watching", [&] {
                  for (;;) {
                    sc_core::wait(clk.posedge_event());
                    (rst != low ? in_reset : behind) += 1;
                    if (rst == low)
                      rises.push_back(static_cast<std::int64_t>(sc_core::sc_time_stamp().value()));
                  }
                });
                sc_core::sc_start(sc_core::sc_time(35, sc_core::SC_NS));
                std::string text = std::to_string(in_reset) + " in reset, then at";
                for (const std::int64_t rise : rises) text += " " + std::to_string(rise);
                return text;
              }),
              "5 in reset, then at 10000 20000 30000");
  }
}

TEST(PinClock, StandsWhenNothingHasPassedForAsLongAsItIsTold) {
  for (const std::uint64_t after : {0, 7}) {
    EXPECT_EQ(in_child([after] {
                PinBench<int, int> bench(numbers(3), {{5, 6, 900}, {0, 0, 0}}, 1);
                PinClockConfig config;
                config.rest_after = after;
                Wires wires(bench, {}, {}, config);
                bench.run(2000);
                std::string text;
                for (const std::int64_t date : bench.out_dates.written) text += std::to_string(date) + " ";
                text += std::to_string(bench.in.statistics().starved_on_empty.count());
                return text + (sc_core::sc_pending_activity() ? " runs " : " stands ") +
                       std::to_string(wires.clock.cycles());
              }),
              after == 0 ? "6 8 901 897 runs 2000" : "6 8 901 897 stands 24")
        << after;
  }
}

// As it stands, the simulation runs dry, and it can be said who waits.
TEST(PinClock, StandsWhenTheEndsAreStuck) {
  EXPECT_EQ(in_child([] {
              PinBench<int, int> bench(numbers(6), {Dates(6, 0), Dates(2, 0)}, 2);
              PinClockConfig config;
              config.rest_after = 5;
              Wires wires(bench, {}, {}, config);
              bench.run();
              return describe(bench.dataflow.waits()) + std::to_string(wires.clock.cycles());
            }),
            "  sink waits on stream out (full, depth 2) for nobody\n10");
}

}  // namespace pin_ends_test
}  // namespace parallax::test
