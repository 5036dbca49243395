// SPDX-License-Identifier: Apache-2.0
// Several listeners on the same parts: each is called as if it were alone.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/timing/firing_log.hpp"
#include "tests/timing/in_child.hpp"
#include "tests/timing/model_simulation.hpp"
#include "tests/timing/statistics_text.hpp"
#include "tests/tlm/thread.hpp"

namespace parallax::test {
namespace several_listeners_test {

// Notes every call, with its arguments. `patience`: firings.
class StageCalls final : public StageListener {
 public:
  explicit StageCalls(std::uint64_t patience) { set_patience(patience); }
  std::string text;

 private:
  void fired(const Stage& stage, const FiringDates& firing) override {
    text += fmt::format("{} fires {};", stage.basename(), firing.start.count());
  }
  void repeated(const Stage& stage, const std::vector<FiringDates>& period, Cycles later, Cycles every,
                std::uint64_t times) override {
    text += fmt::format("{} again {}..{} +{} every {} x {};", stage.basename(), period.front().start.count(),
                        period.back().start.count(), later.count(), every.count(), times);
  }
};

class StreamCalls final : public StreamListener {
 public:
  std::string text;

 private:
  void written(const StreamBase&, Cycles cycle) override { text += fmt::format("w{};", cycle.count()); }
  void read(const StreamBase&, Cycles cycle) override { text += fmt::format("r{};", cycle.count()); }
  void written_again(const StreamBase&, const std::vector<Cycles>& period, Cycles every,
                     std::uint64_t times) override {
    text += fmt::format("w{}+{}x{};", period.front().count(), every.count(), times);
  }
  void read_again(const StreamBase&, const std::vector<Cycles>& period, Cycles every,
                  std::uint64_t times) override {
    text += fmt::format("r{}+{}x{};", period.front().count(), every.count(), times);
  }
};

// A source, a stage that reads a pixel in each of 3000 cycles of a row and then pauses, and a sink in kernel
// time that comes too late now and then, so that leaps are many.
Graph rows() {
  std::vector<std::uint32_t> late = no_stalls(9000);
  for (const std::size_t token : {700U, 2500U, 6100U}) late[token] = 100;
  Graph graph;
  graph.nodes = {source(no_stalls(9000)),
                 stage(1).times(3000, {fires().reads(1).writes(1)}).times(1, {idles(50)}), sink(late)};
  graph.edges = {link(0, 1).deep(4), link(1, 2).deep(2000)};
  return graph;
}

constexpr std::uint64_t kSinkIsAThread = 0b100;

std::string stage_calls(const std::vector<std::uint64_t>& patience, std::size_t of) {
  return in_child([&] {
    ModelSimulation simulation(rows(), kSinkIsAThread);
    std::deque<StageCalls> calls;
    for (const std::uint64_t firings : patience) {
      simulation.dataflow().stages()[1]->add_listener(calls.emplace_back(firings));
    }
    simulation.run();
    return calls[of].text;
  });
}

TEST(SeveralListeners, OfAStageEachHaveTheirOwnPatience) {
  const std::string hasty = stage_calls({0}, 0);
  const std::string patient = stage_calls({1000}, 0);
  ASSERT_NE(hasty.find("again"), std::string::npos);
  ASSERT_NE(hasty, patient);
  EXPECT_EQ(stage_calls({0, 1000}, 0), hasty);
  EXPECT_EQ(stage_calls({0, 1000}, 1), patient);
  EXPECT_EQ(stage_calls({1000, 77, 0}, 0), patient);
  EXPECT_EQ(stage_calls({1000, 77, 0}, 2), hasty);
}

TEST(SeveralListeners, OfAStreamAllGetEveryDate) {
  const auto calls = [](std::size_t listeners, std::size_t of) {
    return in_child([&] {
      ModelSimulation simulation(rows(), kSinkIsAThread);
      std::deque<StreamCalls> all(listeners);
      for (StreamCalls& one : all) simulation.dataflow().streams()[0]->add_listener(one);
      simulation.run();
      return all[of].text;
    });
  };
  const std::string alone = calls(1, 0);
  ASSERT_NE(alone.find('x'), std::string::npos);
  EXPECT_EQ(calls(2, 0), alone);
  EXPECT_EQ(calls(2, 1), alone);
}

// One that comes while a leap is under way, and goes in another, misses nothing between.
TEST(SeveralListeners, ComeAndGoInTheMidstOfALeap) {
  EXPECT_EQ(
      in_child([&] {
        ModelSimulation simulation(rows(), kSinkIsAThread);
        Stage& stage = *simulation.dataflow().stages()[1];
        StreamBase& stream = *simulation.dataflow().streams()[0];
        EdgeDates all, some;
        DateLog log(all), guest(some);
        FiringLog firings(stage), firings_seen(stage);
        stage.remove_listener(firings_seen);
        stream.add_listener(log);
        StreamStatistics came, went;
        StageStatistics at_coming, at_going;
        const auto cycle = [](int cycles) { return sc_core::sc_time(cycles * 10 / 30.0, sc_core::SC_NS); };
        Thread visits("visits", [&] {
          sc_core::wait(cycle(1500));
          stream.add_listener(guest);
          stage.add_listener(firings_seen);
          came = stream.statistics();
          at_coming = stage.statistics();
          sc_core::wait(cycle(5000));
          stream.remove_listener(guest);
          stage.remove_listener(firings_seen);
          went = stream.statistics();
          at_going = stage.statistics();
        });
        simulation.run();
        const auto slice = [](const std::vector<std::int64_t>& dates, std::uint64_t from, std::uint64_t to) {
          return std::vector<std::int64_t>(dates.begin() + static_cast<std::ptrdiff_t>(from),
                                           dates.begin() + static_cast<std::ptrdiff_t>(to));
        };
        std::string faults;
        if (came.written == 0 || went.written - came.written < 3000) faults += "too short a visit\n";
        if (some.written != slice(all.written, came.written, went.written)) faults += "writes\n";
        if (some.read != slice(all.read, came.read, went.read)) faults += "reads\n";
        at_going -= at_coming;
        if (text_of(firings_seen.sums) != text_of(at_going)) {
          faults += text_of(firings_seen.sums) + " is not " + text_of(at_going);
        }
        return faults;
      }),
      "");
}

}  // namespace several_listeners_test
}  // namespace parallax::test
