// SPDX-License-Identifier: Apache-2.0
// The first breach of a handshake is found in its cycle; what keeps to the protocol is not blamed.
#include "tlm/axi_stream_checker.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/timing/in_child.hpp"
#include "tests/tlm/pin_bench.hpp"

namespace parallax::test {
namespace axi_stream_checker_test {

using sc_dt::sc_logic;
using sc_dt::sc_lv;

/// The pins of a cycle, "rst valid ready data last user", each a character of 0, 1, X and Z.
using Cycle = const char*;

// What the checker says of these cycles, and how many tokens it has seen pass.
std::string said_of(const std::vector<Cycle>& cycles, bool reset_is_low = false) {
  return in_child([&]() -> std::string {
    const ClockDomain domain("domain", Hertz(100'000'000));
    sc_core::sc_signal<bool> clk, rst;
    sc_core::sc_signal<sc_logic> valid, ready, last, user;
    sc_core::sc_signal<sc_lv<4>> data;
    AxiStreamChecker<sc_lv<4>, sc_logic> checker("checker", domain, reset_is_low);
    checker.clock(clk);
    checker.reset(rst);
    checker.valid(valid);
    checker.ready(ready);
    checker.data(data);
    checker.last(last);
    checker.user(user);
    static std::string reported;
    sc_core::sc_report_handler::set_handler(
        [](const sc_core::sc_report& report, const sc_core::sc_actions&) { reported += report.get_msg(); });
    Thread driving("driving", [&] {
      for (std::size_t i = 0; i < cycles.size(); ++i) {
        const Cycle pins = cycles[i];
        clk = false;
        rst = pins[0] == '1';
        valid = sc_logic(pins[1]);
        ready = sc_logic(pins[2]);
        data = sc_lv<4>((std::string("01") + pins[3] + "0").c_str());
        last = sc_logic(pins[4]);
        user = sc_logic(pins[5]);
        domain.wait_until(Cycles(static_cast<std::int64_t>(i + 1)));
        clk = true;
        sc_core::wait(sc_core::sc_time(1, sc_core::SC_NS));
      }
    });
    sc_core::sc_start();
    if (reported != checker.breach()) return "reported: " + reported;
    return checker.breach() + "; " + std::to_string(checker.tokens());
  });
}

TEST(AxiStreamChecker, LetsPassWhatKeepsToTheProtocol) {
  // Reset, idle with anything on the data, waiting, taken, at once, idle.
  EXPECT_EQ(
      said_of({"10XXXX", "100000", "000XXX", "010110", "010110", "011110", "011001", "001XZX", "000111"}),
      "; 2");
  // Offered until reset takes it back.
  EXPECT_EQ(said_of({"010100", "100100", "001000"}), "; 0");
  EXPECT_EQ(said_of({"000000", "100000", "111111"}, true), "; 1");
}

TEST(AxiStreamChecker, FindsTheFirstBreachInItsCycle) {
  EXPECT_EQ(said_of({"100000", "110000"}), "checker: valid is not 0 in reset, in cycle 1; 0");
  EXPECT_EQ(said_of({"1X0000"}), "checker: valid is not 0 in reset, in cycle 0; 0");
  EXPECT_EQ(said_of({"100000", "010000"}, true), "checker: valid is not 0 in reset, in cycle 1; 0");
  EXPECT_EQ(said_of({"011000", "010000", "000000"}),
            "checker: valid goes from 1 to 0 before token 1 was taken, in cycle 2; 1");
  EXPECT_EQ(said_of({"010000", "011100"}), "checker: data changes before token 0 was taken, in cycle 1; 1");
  EXPECT_EQ(said_of({"010000", "011010"}), "checker: last changes before token 0 was taken, in cycle 1; 1");
  EXPECT_EQ(said_of({"010000", "011001"}), "checker: user changes before token 0 was taken, in cycle 1; 1");
  EXPECT_EQ(said_of({"0X1000"}), "checker: valid is unknown at token 0, in cycle 0; 0");
  EXPECT_EQ(said_of({"001000", "00Z000"}), "checker: ready is unknown at token 0, in cycle 1; 0");
  EXPECT_EQ(said_of({"011000", "011X00"}), "checker: data is unknown at token 1, in cycle 1; 2");
  EXPECT_EQ(said_of({"0110X0"}), "checker: last is unknown at token 0, in cycle 0; 1");
  EXPECT_EQ(said_of({"01100X"}), "checker: user is unknown at token 0, in cycle 0; 1");
  // The first one stays.
  EXPECT_EQ(said_of({"010000", "000000", "0X1000"}),
            "checker: valid goes from 1 to 0 before token 0 was taken, in cycle 1; 0");
}

TEST(AxiStreamChecker, EndsTheSimulationIfNobodyAsksForSomethingElse) {
  EXPECT_NE(in_child([]() -> std::string {
              const ClockDomain domain("domain", Hertz(100'000'000));
              sc_core::sc_signal<bool> clk, valid, ready;
              sc_core::sc_signal<std::uint32_t> data;
              AxiStreamChecker<std::uint32_t> checker("checker", domain);
              checker.clock(clk);
              checker.valid(valid);
              checker.ready(ready);
              checker.data(data);
              Thread driving("driving", [&] {
                for (int i = 0; i < 2; ++i) {
                  valid = i == 0;
                  sc_core::wait(sc_core::sc_time(10, sc_core::SC_NS));
                  clk = true;
                  sc_core::wait(sc_core::sc_time(1, sc_core::SC_NS));
                  clk = false;
                }
              });
              sc_core::sc_start();
              return "it goes on";
            }).find("valid goes from 1 to 0 before token 0 was taken, in cycle 2"),
            std::string::npos);
}

// What the ends drive keeps to the protocol, under stalls and with a reset, in each cycle of PinClock.
TEST(AxiStreamChecker, HasNothingAgainstTheEndsOfStreams) {
  EXPECT_EQ(in_child([]() -> std::string {
              std::vector<int> numbers(300);
              for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<int>(i * 7 % 16);
              PinBench<int, int> bench(numbers, drawn_times(numbers.size(), 11));
              PinClock clock("clock", bench.clock);
              PinConfig config;
              config.stall = 300;
              config.row_tokens = 5;
              config.frame_tokens = 15;
              sc_core::sc_signal<bool> clk, rst;
              PinSignals<sc_lv<4>, sc_logic> pins;
              sc_core::sc_signal<sc_logic> last, user;
              PinSource<int, sc_lv<4>, sc_logic> source("source", clock, config);
              PinSink<int, sc_lv<4>, sc_logic> sink("sink", clock, config,
                                                    [](const sc_lv<4>& bits) { return bits.to_int(); });
              clock.clock(clk);
              clock.reset(rst);
              source.in(bench.in);
              source.bind(pins);
              source.last(last);
              source.first(user);
              sink.out(bench.out);
              sink.bind(pins);
              AxiStreamChecker<sc_lv<4>, sc_logic> checker("checker", bench.clock);
              checker.clock(clk);
              checker.reset(rst);
              checker.valid(pins.valid);
              checker.ready(pins.ready);
              checker.data(pins.data);
              checker.last(last);
              checker.user(user);
              bench.run();
              return checker.breach() + "; " + std::to_string(checker.tokens());
            }),
            "; 300");
}

}  // namespace axi_stream_checker_test
}  // namespace parallax::test
