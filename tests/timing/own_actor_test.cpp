// SPDX-License-Identifier: Apache-2.0
// A block that is neither a Stage nor a thread: an actor of its own, whose pace depends on what it has seen.
// It stands between ordinary stages, and none of them notices.
#include <gtest/gtest.h>

#include <memory>

#include "tests/timing/date_log.hpp"
#include "tests/timing/in_child.hpp"
#include "tests/timing/model_simulation.hpp"

namespace parallax::test {
namespace own_actor_test {

constexpr std::uint32_t kTokens = 3000;

// Cycles from one token to the next; 2, with an outlier now and then.
std::uint32_t pace(std::uint64_t token) { return (token * token) % 101 == 0 ? 9 : 2; }

/// Copies tokens, combinationally, at a pace that it decides from token to token.
class OwnPace final : public sc_core::sc_module, public Actor {
 public:
  StreamIn<int> in{"in"};
  StreamOut<int> out{"out"};

  OwnPace(const sc_core::sc_module_name& name, Dataflow& dataflow) : sc_module(name), dataflow_(dataflow) {}

  void advance() override {
    for (;;) {
      StreamBase& from = *in[0];
      StreamBase& to = *out[0];
      if (!from.read_date_known()) return from.wait_for_token();
      if (!to.write_date_known()) return to.wait_for_room();
      const Cycles date = std::max({free_, from.readable_at(), to.writable_at()});
      from.mark_read(date, std::max(Cycles(0), from.readable_at() - free_));
      to.mark_written(date, std::max(Cycles(0), to.writable_at() - std::max(free_, from.readable_at())));
      free_ = date + Cycles(pace(token_++));
    }
  }

 private:
  void start_of_simulation() override { dataflow_.wake(*this); }

  Dataflow& dataflow_;
  Cycles free_{0};
  std::uint64_t token_ = 0;
};

// source -> copy -> middle -> copy -> sink
template <class Middle, class MakeMiddle>
std::string dates_with(const MakeMiddle& make) {
  Dataflow dataflow("dataflow");
  const ClockDomain clock("clock", Hertz(100'000'000));
  GraphStage source("source", clock, dataflow, stage(0).times(kTokens, {fires().writes(1)}), 1, 0, 1);
  GraphStage before("before", clock, dataflow, copying(3, kTokens), 0, 1, 1);
  const std::unique_ptr<Middle> middle = make(clock, dataflow);
  GraphStage after("after", clock, dataflow, copying(4, kTokens), 0, 1, 1);
  GraphStage sink("sink", clock, dataflow, stage(0).times(kTokens, {fires().reads(1)}), 0, 1, 0);
  std::vector<std::unique_ptr<Stream<int>>> streams;
  std::vector<EdgeDates> dates(4);
  std::vector<std::unique_ptr<DateLog>> logs;
  for (int i = 0; i < 4; ++i) {
    FifoConfig fifo;
    fifo.depth = 16;
    streams.push_back(
        std::make_unique<Stream<int>>(fmt::format("s{}", i).c_str(), dataflow, clock, clock, fifo));
    logs.push_back(std::make_unique<DateLog>(dates[static_cast<std::size_t>(i)]));
    streams.back()->add_listener(*logs.back());
  }
  (*source.out[0])(*streams[0]);
  (*before.in[0])(*streams[0]);
  (*before.out[0])(*streams[1]);
  middle->in_port()(*streams[1]);
  middle->out_port()(*streams[2]);
  (*after.in[0])(*streams[2]);
  (*after.out[0])(*streams[3]);
  (*sink.in[0])(*streams[3]);
  sc_core::sc_start();
  std::string text;
  for (const EdgeDates& edge : dates) {
    for (const std::int64_t date : edge.written) text += fmt::format("{} ", date);
    for (const std::int64_t date : edge.read) text += fmt::format("{} ", date);
    text += "\n";
  }
  return text;
}

struct ActorMiddle {
  OwnPace block;
  StreamIn<int>& in_port() { return block.in; }
  StreamOut<int>& out_port() { return block.out; }
};
struct StageMiddle {
  GraphStage block;
  StreamIn<int>& in_port() { return *block.in[0]; }
  StreamOut<int>& out_port() { return *block.out[0]; }
};

TEST(OwnActor, HasTheDatesOfAStageThatDoesTheSameBySchedule) {
  const std::string actor = in_child([] {
    return dates_with<ActorMiddle>([](const ClockDomain&, Dataflow& dataflow) {
      return std::unique_ptr<ActorMiddle>(new ActorMiddle{{"middle", dataflow}});
    });
  });
  const std::string by_schedule = in_child([] {
    GraphNode node = stage(0);
    for (std::uint64_t token = 0; token < kTokens; ++token) {
      node.parts.push_back({1, {fires().reads(1).writes(1).every(pace(token))}});
    }
    return dates_with<StageMiddle>([&](const ClockDomain& clock, Dataflow& dataflow) {
      return std::unique_ptr<StageMiddle>(new StageMiddle{{"middle", clock, dataflow, node, 0, 1, 1}});
    });
  });
  EXPECT_EQ(actor, by_schedule);
  EXPECT_EQ(std::count(actor.begin(), actor.end(), ' '), 8 * kTokens);
}

}  // namespace own_actor_test
}  // namespace parallax::test
