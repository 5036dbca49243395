// SPDX-License-Identifier: Apache-2.0
// More than 10^9 cycles of three clocks of which none divides another: the last dates are the exact ones,
// computed here in integers from the rules in the headers.
#include <gtest/gtest.h>

#include <memory>

#include "tlm/stage.hpp"
#include "tlm/stream.hpp"

namespace parallax::test {
namespace long_run_test {

__extension__ using Wide = __int128;

constexpr std::int64_t kCoreHz = 175'000'000;
constexpr std::int64_t kFastHz = 533'333'333;
constexpr std::int64_t kVideoHz = 74'250'000;
constexpr std::uint32_t kTokens = 1002;

// The `edges`-th edge of the clock `to` after edge `cycle` of the clock `from`.
std::int64_t cross(std::int64_t cycle, std::int64_t from, std::int64_t to, std::int64_t edges) {
  return static_cast<std::int64_t>(Wide{cycle} * to / from) + edges;
}

struct Pace {
  std::uint32_t interval;
  std::uint32_t latency;
};

// Passes kTokens tokens on.
class Beat final : public Stage {
 public:
  Beat(const sc_core::sc_module_name& name, const ClockDomain& clock, Dataflow& dataflow, const Pace& pace,
       Stream<int>* in, Stream<int>* out)
      : Stage(name, clock, dataflow, pace.latency) {
    if (in != nullptr) {
      in_ = std::make_unique<StreamIn<int>>("in");
      (*in_)(*in);
    }
    if (out != nullptr) {
      out_ = std::make_unique<StreamOut<int>>("out");
      (*out_)(*out);
    }
    set_schedule(Schedule().run(
        fires(kTokens).reads(in != nullptr ? 1 : 0).writes(out != nullptr ? 1 : 0).every(pace.interval)));
    set_frame_limit(1);
  }

 private:
  std::unique_ptr<StreamIn<int>> in_;
  std::unique_ptr<StreamOut<int>> out_;
};

// A camera's clock feeds a fast one feeds a display's.
struct ThreeClocks {
  ThreeClocks(const Pace& first_pace, const Pace& second_pace, const Pace& third_pace, const FifoConfig& fifo)
      : one("one", dataflow, core, fast, fifo),
        two("two", dataflow, fast, video, fifo),
        first("first", core, dataflow, first_pace, nullptr, &one),
        second("second", fast, dataflow, second_pace, &one, &two),
        third("third", video, dataflow, third_pace, &two, nullptr) {
    sc_core::sc_start();
  }
  const ClockDomain core{"core", Hertz(kCoreHz)};
  const ClockDomain fast{"fast", Hertz(kFastHz)};
  const ClockDomain video{"video", Hertz(kVideoHz)};
  Dataflow dataflow{"dataflow"};
  Stream<int> one;
  Stream<int> two;
  Beat first;
  Beat second;
  Beat third;
};

constexpr FifoConfig kFifo{1, Bits(8), 3, 2};  // two more edges forward and one back, as synchronisers

// The first stage sets the pace: every date follows from its own.
TEST(LongRun, DatesDoNotDriftDownstream) {
  constexpr std::int64_t kInterval = 999'983;
  constexpr std::int64_t kLast = kInterval * (kTokens - 1);
  ASSERT_GT(kLast, 1'000'000'000);
  const ThreeClocks graph({kInterval, 5}, {1, 7}, {1, 0}, kFifo);
  EXPECT_EQ(graph.first.frames()[0].last_firing.count(), kLast);
  const std::int64_t second = cross(kLast + 5, kCoreHz, kFastHz, 3);
  EXPECT_EQ(graph.second.frames()[0].last_firing.count(), second);
  EXPECT_EQ(graph.third.frames()[0].last_firing.count(), cross(second + 7, kFastHz, kVideoHz, 3));
}

// The last stage sets the pace: the others wait for room. A FIFO and a pipeline of one slot each hold four
// tokens.
TEST(LongRun, DatesDoNotDriftUpstream) {
  constexpr std::int64_t kInterval = 427'001;
  const ThreeClocks graph({1, 1}, {1, 1}, {kInterval, 0}, kFifo);
  const std::int64_t begin = cross(cross(1, kCoreHz, kFastHz, 3) + 1, kFastHz, kVideoHz, 3);
  const auto third = [&](std::int64_t token) { return begin + kInterval * token; };
  constexpr std::int64_t kLast = kTokens - 1;
  EXPECT_EQ(graph.third.frames()[0].last_firing.count(), third(kLast));
  const auto second_writes = [&](std::int64_t token) {
    return cross(third(token - 1), kVideoHz, kFastHz, 2);
  };
  EXPECT_EQ(graph.second.frames()[0].last_write.count(), second_writes(kLast));
  // The second stage reads a token when the one before leaves its pipeline.
  const std::int64_t first_writes = cross(second_writes(kLast - 2), kFastHz, kCoreHz, 2);
  EXPECT_EQ(graph.first.frames()[0].last_write.count(), first_writes);
  ASSERT_GT(first_writes, 1'000'000'000);
}

}  // namespace long_run_test
}  // namespace parallax::test
