// SPDX-License-Identifier: Apache-2.0
// A stage whose last register is on wires to its reader, with no FIFO between: the register is the FIFO of
// offsets 1 and 0 and one slot, behind a stage of one cycle less.
#include <gtest/gtest.h>

#include <random>

#include "tests/timing/date_log.hpp"
#include "tests/timing/in_child.hpp"
#include "tests/timing/model_simulation.hpp"

namespace parallax::test {
namespace wire_test {

struct WireDates {
  std::vector<std::int64_t> into_stage, out_of_stage;
};

// Registers that move on when the next one is free or moves, from a source whose token i is there at
// `offered[i]` at the earliest, to a reader that takes token i so many cycles after the one before at the
// earliest.
WireDates registers(std::size_t latency, const std::vector<std::int64_t>& offered,
                    const std::vector<std::uint32_t>& stalls) {
  WireDates dates;
  std::vector<bool> holds(latency, false);
  std::int64_t reader_ready = stalls[0];
  for (std::int64_t cycle = 0; dates.out_of_stage.size() < stalls.size(); ++cycle) {
    bool next_free = false;
    if (holds.back() && cycle >= reader_ready) {
      const std::size_t read = dates.out_of_stage.size();
      dates.out_of_stage.push_back(cycle);
      if (read + 1 < stalls.size()) reader_ready = cycle + 1 + stalls[read + 1];
      next_free = true;
    }
    next_free = next_free || !holds.back();
    std::vector<bool> after = holds;
    for (std::size_t i = latency; i-- > 0;) {
      const bool from =
          i > 0 ? holds[i - 1]
                : dates.into_stage.size() < offered.size() && offered[dates.into_stage.size()] <= cycle;
      if (i + 1 < latency) next_free = next_free || !holds[i];
      if (!next_free) continue;
      after[i] = from;
      if (i == 0 && from) dates.into_stage.push_back(cycle);
    }
    holds = after;
  }
  return dates;
}

TEST(Wire, IsTheLastRegisterOfTheStage) {
  std::minstd_rand random(3);
  for (int round = 0; round < 40; ++round) {
    const std::size_t latency = 1 + random() % 6;
    std::vector<std::uint32_t> source_stalls, sink_stalls;
    for (int i = 0; i < 200; ++i) {
      source_stalls.push_back(static_cast<std::uint32_t>(random() % 3));
      sink_stalls.push_back(static_cast<std::uint32_t>(random() % 3 == 0 ? random() % 9 : 0));
    }
    Graph graph;
    graph.nodes = {source(source_stalls), copying(static_cast<std::uint32_t>(latency - 1), 200),
                   sink(sink_stalls)};
    graph.edges = {link(0, 1).deep(1000), link(1, 2).deep(1).offsets(1, 0)};
    const std::string difference = in_child([&] {
      const std::vector<EdgeDates> model = ModelSimulation(graph, 0).run();
      std::vector<std::int64_t> offered;
      for (const std::int64_t date : model[0].written) offered.push_back(date + 1);
      const WireDates expected = registers(latency, offered, sink_stalls);
      if (model[0].read != expected.into_stage) return "into the stage";
      return model[1].read != expected.out_of_stage ? "out of the stage" : "";
    });
    EXPECT_EQ(difference, "") << "latency " << latency;
  }
}

}  // namespace wire_test
}  // namespace parallax::test
