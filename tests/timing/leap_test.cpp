// SPDX-License-Identifier: Apache-2.0
// Leaps over periodic motion change nothing: every date and every statistic is that of going firing by
// firing.
#include "tlm/leap.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <deque>
#include <sstream>

#include "tests/timing/firing_log.hpp"
#include "tests/timing/in_child.hpp"
#include "tests/timing/model_simulation.hpp"
#include "tests/timing/pipeline_simulation.hpp"
#include "tests/timing/random_graph.hpp"
#include "tests/timing/random_pipeline.hpp"
#include "tests/timing/reference_simulation.hpp"
#include "tests/timing/statistics_text.hpp"

namespace parallax::test {
namespace leap_test {

// So seldom is there a look for periodic motion that there is none.
constexpr std::uint64_t kBatchesAlone = std::uint64_t{1} << 40;

template <class Simulation>
std::string outcome(Simulation& simulation) {
  std::string text;
  std::deque<FiringLog> logs;
  for (Stage* stage : simulation.dataflow().stages()) logs.emplace_back(*stage);
  const std::vector<EdgeDates> dates = simulation.run();
  for (const StreamBase* stream : simulation.dataflow().streams()) text += statistics_text(*stream);
  std::size_t log = 0;
  for (const Stage* stage : simulation.dataflow().stages()) {
    text += statistics_text(*stage) + logs[log].text();
    if (text_of(logs[log++].sums) != text_of(stage->statistics()))
      text += "firings do not sum to the statistics\n";
  }
  for (const Wait& wait : simulation.dataflow().waits())
    text += fmt::format("{} {} waits\n", wait.waiter, wait.on_full);
  for (const EdgeDates& edge : dates) {
    for (const std::int64_t date : edge.written) text += fmt::format("{} ", date);
    text += "| ";
    for (const std::int64_t date : edge.read) text += fmt::format("{} ", date);
    text += "\n";
  }
  return text;
}

std::string first_difference(const std::string& expected, const std::string& actual) {
  std::istringstream a(expected), b(actual);
  std::string x, y;
  while (std::getline(a, x) && std::getline(b, y)) {
    if (x != y) return fmt::format("expected {}\nhave     {}\n", x.substr(0, 2000), y.substr(0, 2000));
  }
  return "";
}

RC_GTEST_PROP(Leap, ChangesNothingInRandomGraphs, ()) {
  const Graph graph = RandomGraph::make(8);
  const auto threads = *rc::gen::arbitrary<std::uint64_t>();
  const auto interval = *rc::gen::element<std::uint64_t>(1, 10, 40, 200, kBatchesAlone);
  const auto run = [&](std::uint64_t leap_interval) {
    return in_child([&] {
      ModelSimulation simulation(graph, threads, leap_interval);
      return outcome(simulation);
    });
  };
  const std::string difference = first_difference(run(0), run(interval));
  if (!difference.empty()) {
    std::ostringstream description;
    description << difference << "threads " << threads << " leap interval " << interval << graph;
    RC_FAIL(description.str());
  }
}

RC_GTEST_PROP(Leap, ChangesNothingInThePipeline, ()) {
  const PipelineCase c = random_pipeline(Depths::kAutomatic, 2, 8);
  const auto run = [&](std::uint64_t leap_interval) {
    return in_child([&] {
      PipelineSimulation simulation(c, leap_interval);
      return outcome(simulation);
    });
  };
  const std::string difference =
      first_difference(run(0), run(*rc::gen::element<std::uint64_t>(50, 600, kBatchesAlone)));
  if (!difference.empty()) RC_FAIL(difference);
}

// Asks all streams again and again how full they have been, in the midst of leaps.
class FillProbe final : public sc_core::sc_module {
 public:
  FillProbe(const Dataflow& dataflow, const sc_core::sc_time& pace, int times)
      : sc_module(sc_core::sc_module_name("probe")), dataflow_(dataflow), pace_(pace), times_(times) {
    SC_HAS_PROCESS(FillProbe);
    SC_THREAD(run);
  }
  std::vector<std::vector<FifoFill>> fills;  // of each stream

 private:
  void run() {
    fills.resize(dataflow_.streams().size());
    for (int i = 0; i < times_; ++i) {
      wait(pace_);
      for (std::size_t s = 0; s < fills.size(); ++s) dataflow_.streams()[s]->fill(fills[s].emplace_back());
    }
  }

  const Dataflow& dataflow_;
  const sc_core::sc_time pace_;
  const int times_;
};

// What was asked, from the dates of all tokens.
std::string differences(const GraphEdge& edge, const EdgeDates& dates, const FifoFill& fill) {
  std::vector<std::pair<std::int64_t, int>> changes;  // of the level
  for (const std::int64_t date : dates.written) changes.emplace_back(date, +1);
  for (const std::int64_t date : dates.read) changes.emplace_back(date + edge.read_to_write, -1);
  std::sort(changes.begin(), changes.end());
  FifoFill expected;
  const auto pass = [&](std::int64_t until) {
    const auto cycles = static_cast<std::uint64_t>(until - expected.until.count());
    expected.token_cycles += expected.level() * cycles;
    if (expected.level() == 0) expected.empty_cycles += cycles;
    if (expected.level() == edge.depth) expected.full_cycles += cycles;
    expected.until = Cycles(until);
  };
  std::uint64_t last_written = 0, last_freed = 0;  // those at the very date may count, or not yet
  for (const auto& [date, change] : changes) {
    if (Cycles(date) > fill.until) break;
    if (Cycles(date) < fill.until) {
      pass(date);
      ++(change > 0 ? expected.written : expected.freed);
    } else {
      ++(change > 0 ? last_written : last_freed);
    }
  }
  pass(fill.until.count());
  const auto text = [](const FifoFill& f) {
    return fmt::format("until {}: {} token cycles, {} full, {} empty", f.until.count(), f.token_cycles,
                       f.full_cycles, f.empty_cycles);
  };
  const bool counts = fill.written >= expected.written && fill.written <= expected.written + last_written &&
                      fill.freed >= expected.freed && fill.freed <= expected.freed + last_freed;
  return counts && text(expected) == text(fill) ? "" : text(expected) + ", have " + text(fill) + "\n";
}

RC_GTEST_PROP(Leap, TheFillOfAFifoIsKnownWithin, ()) {
  const Graph graph = RandomGraph::make(6);
  const auto threads = *rc::gen::arbitrary<std::uint64_t>();
  const auto interval = *rc::gen::element<std::uint64_t>(10, 40);
  const auto pace = *rc::gen::inRange(1, 200);
  const std::string wrong = in_child([&] {
    ModelSimulation simulation(graph, threads, interval);
    FillProbe probe(simulation.dataflow(), sc_core::sc_time(pace, sc_core::SC_NS), 100);
    const std::vector<EdgeDates> dates = simulation.run();
    std::string text;
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
      const GraphEdge& edge = graph.edges[e];
      const auto clock = [&](int node) { return graph.nodes[static_cast<std::size_t>(node)].clock; };
      if (clock(edge.from) != clock(edge.to)) continue;  // freed in cycles of another clock
      for (const FifoFill& fill : probe.fills[e]) text += differences(edge, dates[e], fill);
    }
    return text;
  });
  if (!wrong.empty()) RC_FAIL(wrong.substr(0, 1000));
}

// source -> stage -> stage -> sink, all actors, `tokens` of them.
Graph chain(std::uint32_t tokens, std::uint32_t interval, std::uint32_t latency, std::uint32_t depth) {
  Graph graph;
  graph.nodes = {source(no_stalls(tokens)), copying(latency, tokens), copying(latency, tokens, interval),
                 sink(no_stalls(tokens))};
  graph.edges = {link(0, 1).deep(depth), link(1, 2).deep(depth), link(2, 3).deep(depth)};
  return graph;
}

TEST(Leap, GoesThroughMostOfARegularChain) {
  constexpr std::uint32_t kTokens = 20000;
  ModelSimulation simulation(chain(kTokens, 3, 5, 16), 0);
  const std::vector<EdgeDates> dates = simulation.run();
  // A token into the FIFO a cycle, one out of the slow stage every third.
  EXPECT_EQ(dates[2].read.back(), 1 + 1 + 5 + 1 + 5 + 3 * (std::int64_t{kTokens} - 1));
  EXPECT_GT(simulation.dataflow().leaped_firings(), 4 * kTokens * 9 / 10);
}

TEST(Leap, CanBeSwitchedOff) {
  ModelSimulation simulation(chain(5000, 3, 5, 16), 0, 0);
  simulation.run();
  EXPECT_EQ(simulation.dataflow().leaped_firings(), 0u);
}

}  // namespace leap_test
}  // namespace parallax::test
