// SPDX-License-Identifier: Apache-2.0
// What cannot be of a circuit at pins is refused with one line.
#include <gtest/gtest.h>

#include <string>

#include "tests/timing/in_child.hpp"
#include "tlm/pin_sink.hpp"
#include "tlm/pin_source.hpp"

namespace parallax::test {
namespace pin_refusals_test {

std::string refusal(const PinConfig& config, bool pins_of_rows = false, std::uint32_t in_depth = 8,
                    std::int64_t pin_hertz = 100'000'000, bool valid_out = true) {
  return in_child([&]() -> std::string {
    const ClockDomain streams("streams", Hertz(100'000'000)), domain("pins", Hertz(pin_hertz));
    Dataflow dataflow("dataflow");
    FifoConfig fifo;
    fifo.depth = in_depth;
    Stream<int> in("in", dataflow, streams, streams, fifo);
    Stream<int> out("out", dataflow, streams, streams, {8});
    PinClock clock("clock", domain);
    PinSignals<std::uint32_t> pins;
    sc_core::sc_signal<bool> first, last;
    PinSource<int, std::uint32_t> source("source", clock, config);
    PinSink<int, std::uint32_t> sink("sink", clock, config);
    source.in(in);
    source.bind(pins);
    if (pins_of_rows) source.last(last);
    if (pins_of_rows && config.row_tokens > 0) source.first(first);
    sink.out(out);
    sink.data(pins.data);
    if (valid_out) sink.valid(pins.valid);
    sink.ready(pins.ready);
    sc_core::sc_start(sc_core::sc_time(1, sc_core::SC_NS));
    return "accepted";
  });
}

TEST(PinEnds, RefuseWhatCannotBe) {
  const auto with = [](const auto& change) {
    PinConfig config;
    change(config);
    return config;
  };
  EXPECT_EQ(refusal({}), "accepted");
  EXPECT_EQ(refusal(with([](auto& c) { c.interval = 0; })),
            "source: an interval of 0 cycles; it is at least 1");
  EXPECT_EQ(refusal(with([](auto& c) { c.burst = 0; })), "source: a burst of 0 tokens; it has at least 1");
  EXPECT_EQ(refusal(with([](auto& c) { c.stall = 1000; })),
            "source: stalls in 1000 of 1000 cycles are outside 0 to 999");
  EXPECT_EQ(refusal(with([](auto& c) { c.flush = 2; })),
            "source: flush and skip are of a frame, and frame_tokens is 0");
  EXPECT_EQ(refusal(with([](auto& c) { c.skip = 2; })),
            "source: flush and skip are of a frame, and frame_tokens is 0");
  EXPECT_EQ(refusal(with([](auto& c) {
              c.frame_tokens = 10;
              c.row_tokens = 4;
            })),
            "source: a frame of 10 tokens is no whole number of rows of 4");
  EXPECT_EQ(refusal({}, true), "source: the pins last and row are of rows, and row_tokens is 0");
  EXPECT_EQ(refusal(with([](auto& c) { c.row_tokens = 4; }), true),
            "source: the pins first and row are of a frame, and frame_tokens is 0");
  EXPECT_EQ(refusal(with([](auto& c) { c.burst = 8; })), "accepted");
  EXPECT_EQ(refusal(with([](auto& c) { c.burst = 8; }), false, 7),
            "source: bursts of 8 tokens do not fit into stream 'in' of depth 7");
  EXPECT_EQ(refusal(with([](auto& c) { c.burst = 9; }), false, 9),
            "sink: bursts of 9 tokens do not fit into stream 'out' of depth 8");
  EXPECT_EQ(
      refusal({}, false, 8, 50'000'000),
      "source: its stream has the clock 'streams' of 100000000 Hz there, its pins 'pins' of 50000000 Hz");
  EXPECT_EQ(
      refusal(with([](auto& c) {
                c.frame_tokens = 4;
                c.flush = 1;
                c.skip = 2;
              }),
              false, 8, 100'000'000, false),
      "sink: without the pin valid, no more results can be skipped than tokens of zeros follow a frame");
}

TEST(PinClock, RefusesWhatCannotBe) {
  const auto refused = [](const PinClockConfig& config, std::int64_t hertz) {
    return in_child([&]() -> std::string {
      const ClockDomain domain("fast", Hertz(hertz));
      const PinClock clock("clock", domain, config);
      return "accepted";
    });
  };
  PinClockConfig config;
  EXPECT_EQ(refused(config, 1'953'125'000), "accepted");
  EXPECT_EQ(refused(config, 2'000'000'000),
            "clock: a period of 500 ps of clock 'fast' is too short for pins; 512 ps is enough");
  config.reset_cycles = 65;
  EXPECT_EQ(refused(config, 1'000'000), "clock: 65 cycles in reset are outside 0 to 64");
  config = {};
  config.order = 32;
  EXPECT_EQ(refused(config, 1'000'000), "clock: an order of 32 is outside 0 to 31");
}

}  // namespace pin_refusals_test
}  // namespace parallax::test
