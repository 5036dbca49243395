// SPDX-License-Identifier: Apache-2.0
// A stream that is narrower than its tokens is refused when it is built, or where it is connected.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "platform/machine/wiring.hpp"
#include "tests/example/slow_copy.hpp"
#include "tests/platform/error_of.hpp"

namespace parallax::test {
namespace stream_width_test {

const ClockDomain& clock() {
  static const ClockDomain one("clock", Hertz(1000));
  return one;
}

TEST(StreamWidth, ADisparityNeedsItsBits) {
  Dataflow dataflow("dataflow");
  const auto made = [&](const FifoConfig& fifo) {
    return error_of([&] { const Stream<Disparity> mine("mine", dataflow, clock(), clock(), fifo); });
  };
  EXPECT_EQ(made({}), "stream 'mine': its width is 8 bits, and its tokens have 12 (FifoConfig::width)");
  EXPECT_EQ(made({2, Bits(11)}),
            "stream 'mine': its width is 11 bits, and its tokens have 12 (FifoConfig::width)");
}

TEST(StreamWidth, WhatIsConnectedHasTheBitsOfItsTokens) {
  Dataflow dataflow("dataflow");
  const StreamConfig streams;
  Wiring wiring(streams, {clock(), dataflow, 8, 8}, {});
  wiring.place("copy", {}, [](const std::string& name, const StageContext& context) {
    SlotModule slot;
    slot.module = std::make_unique<SlowCopy>(name.c_str(), context.clock);
    return slot;
  });
  Stream<Disparity> wide("wide", dataflow, clock(), clock(), {2, Bits(12)});
  Stream<Disparity> pairs("pairs", dataflow, clock(), clock(), {2, Bits(12)});
  const TokenShape one(disparity_format());
  EXPECT_EQ(error_of([&] { wiring.attach(wide, one, {"copy", "in_disparity"}); }), "(no error)");
  const TokenShape two(disparity_format().several(2));
  EXPECT_EQ(error_of([&] {
              wiring.attach(pairs, two, {"copy", "out_disparity"});
            }),
            "stream 'pairs': its width is 12 bits, and its tokens have 24 (FifoConfig::width)");
}

}  // namespace stream_width_test
}  // namespace parallax::test
