// SPDX-License-Identifier: Apache-2.0
// What the chain benchmarks compare ends at the same date: the reference's.
#include <gtest/gtest.h>

#include "tests/bench/dated_fifo_chain.hpp"
#include "tests/bench/max_plus_chain.hpp"
#include "tests/bench/sc_fifo_chain.hpp"
#include "tests/bench/stage_chain.hpp"
#include "tests/timing/in_child.hpp"
#include "tests/timing/reference_simulation.hpp"

namespace parallax::bench {
namespace chain_dates_test {

using test::Graph;

std::vector<std::uint32_t> stalls(const std::vector<std::uint32_t>& gaps, std::uint64_t tokens) {
  Gaps gap(gaps);
  std::vector<std::uint32_t> all{0};
  while (all.size() < tokens) all.push_back(static_cast<std::uint32_t>(gap.next() - 1));
  return all;
}

std::int64_t reference(const ChainLoad& load) {
  Graph graph;
  graph.nodes.push_back(test::source(stalls(load.source_gaps, load.tokens())));
  for (int i = 0; i < kStages; ++i) {
    graph.nodes.push_back(test::copying(1, 1));
  }
  graph.nodes.push_back(test::sink(stalls(load.sink_gaps, load.tokens())));
  for (int i = 0; i <= kStages; ++i) graph.edges.push_back(test::link(i, i + 1).deep(load.depth));
  return test::ReferenceSimulation(graph).run().back().read.back();
}

// Of a simulation in a process of its own; what went wrong instead, if something did.
std::string last_read(ChainRun (*mechanism)(const ChainLoad&), const ChainLoad& load) {
  return test::in_child([&] { return std::to_string(mechanism(load).last_read); });
}

TEST(ChainDates, EveryExactMechanismEndsWhereTheReferenceDoes) {
  for (const std::uint32_t depth : {1u, 2u, 3u, 16u, 64u}) {
    for (const ChainLoad& whole : {regular_load(depth, 1), stalling_load(depth, 1)}) {
      for (const std::size_t frame : {std::size_t{1}, std::size_t{30}, std::size_t{701}}) {
        ChainLoad load = whole;
        load.source_gaps.resize(frame);
        load.frames = 3;
        const std::string expected = std::to_string(reference(load));
        EXPECT_EQ(last_read(run_max_plus, load), expected) << "depth " << depth << ", frame " << frame;
        EXPECT_EQ(last_read(run_stages, load), expected) << "depth " << depth << ", frame " << frame;
        EXPECT_EQ(last_read(run_dated_fifo, load), expected) << "depth " << depth << ", frame " << frame;
      }
    }
  }
}

// Else the benchmark would compare with something that is as good.
TEST(ChainDates, ScFifoIsEarly) {
  for (const std::uint32_t depth : {1u, 2u, 16u}) {
    const ChainLoad load = stalling_load(depth, 1);
    EXPECT_LT(std::stoll(last_read(run_sc_fifo, load)), std::stoll(last_read(run_max_plus, load)))
        << "depth " << depth;
  }
}

}  // namespace chain_dates_test
}  // namespace parallax::bench
