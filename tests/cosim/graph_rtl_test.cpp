// SPDX-License-Identifier: Apache-2.0
// Stages and FIFOs together against control circuits: a chain, a fork that meets again, a join with a delay
// of two rows, a chain over two clocks. All depths from 1 to 64, random stalls at both ends, every date of
// every FIFO.
#include <Chain8Depth16.h>
#include <Chain8Depth2.h>
#include <Chain8Depth64.h>
#include <GraphChainBank.h>
#include <GraphForkJoinBank.h>
#include <GraphRowDelayBank.h>
#include <GraphTwoClocksBank.h>
#include <gtest/gtest.h>

#include "tests/cosim/rtl_bench.hpp"

namespace parallax::test {
namespace graph_rtl_test {

constexpr std::size_t kTokens = 300;
// The window writes its first token when it has read two rows of 12 and one more; what the fork wrote with
// these lies in the FIFO beside it.
constexpr std::uint32_t kDepthForTwoRows = 25;

GraphNode source_of(std::uint32_t seed) { return source(rtl_stalls(kTokens, 2 * seed)); }
GraphNode sink_of(std::uint32_t seed) { return sink(rtl_stalls(kTokens, 2 * seed + 1)); }
GraphNode copy(std::uint32_t interval, std::uint32_t latency) { return copying(latency, kTokens, interval); }

GraphEdge fifo(int from, int to, std::uint32_t depth, FifoKind kind, std::uint32_t stages = 2) {
  return link(from, to).deep(depth).of_kind(kind, stages);
}
GraphEdge write_when_read(int from, int to, std::uint32_t depth) {  // fifo_free with READ_TO_WRITE 0
  return link(from, to).deep(depth).offsets(1, 0);
}

// tests/rtl/graph_chain.sv
Graph chain(std::uint32_t depth, std::uint32_t seed) {
  Graph graph;
  graph.periods = {1};
  graph.nodes = {source_of(seed), copy(1, 3), copy(2, 0), copy(1, 1), copy(3, 5), sink_of(seed)};
  graph.edges = {fifo(0, 1, depth, FifoKind::kRegistered), fifo(1, 2, depth, FifoKind::kFirstWordFallThrough),
                 fifo(2, 3, depth, FifoKind::kBlockRam), write_when_read(3, 4, depth),
                 fifo(4, 5, depth, FifoKind::kRegistered)};
  return graph;
}

// tests/rtl/graph_fork_join.sv
Graph fork_join(const GraphNode& branch, std::uint32_t depth, std::uint32_t others, std::uint32_t seed) {
  const GraphNode join = stage(2).times(kTokens, {fires().reads(0b11).writes(1)});
  Graph graph;
  graph.periods = {1};
  graph.nodes = {source_of(seed), copy(1, 1), branch, join, sink_of(seed)};
  graph.edges = {fifo(0, 1, others, FifoKind::kFirstWordFallThrough),
                 fifo(1, 2, others, FifoKind::kRegistered), fifo(1, 3, depth, FifoKind::kBlockRam).into(1),
                 fifo(2, 3, others, FifoKind::kFirstWordFallThrough), write_when_read(3, 4, others)};
  return graph;
}
Graph fork_meets_again(std::uint32_t depth, std::uint32_t seed) {
  return fork_join(copy(1, 6), depth, depth, seed);
}
Graph row_delay(std::uint32_t depth, std::uint32_t seed) {
  constexpr std::uint64_t kRow = 12;
  const GraphNode window = stage(2)
                               .times(2 * kRow, {fires().reads(1)})
                               .times(3 * kRow, {fires().reads(1).writes(1)})
                               .times(2 * kRow, {fires().writes(1)});
  return fork_join(window, depth, 4, seed);
}

// tests/rtl/graph_two_clocks.sv
Graph two_clocks(std::uint32_t depth, std::uint32_t seed, const std::vector<std::int64_t>& periods) {
  Graph graph;
  graph.periods = periods;
  graph.nodes = {source_of(seed),        copy(1, 2), copy(2, 1).on_clock(1),
                 copy(1, 0).on_clock(1), copy(1, 4), sink_of(seed)};
  graph.edges = {fifo(0, 1, depth, FifoKind::kRegistered), fifo(1, 2, depth, FifoKind::kAsynchronous),
                 fifo(2, 3, depth, FifoKind::kFirstWordFallThrough),
                 fifo(3, 4, depth, FifoKind::kAsynchronous, 3), fifo(4, 5, depth, FifoKind::kBlockRam)};
  return graph;
}

template <class Make>
std::vector<Graph> all_depths(std::uint32_t seed, const Make& make) {
  std::vector<Graph> graphs;
  for (std::uint32_t depth = 1; depth <= 64; ++depth)
    graphs.push_back(make(depth, seed * 1009u + depth * 13u));
  return graphs;
}

std::uint64_t threads(std::uint32_t seed) { return seed % 2 == 0 ? 0 : 0x5a3c'9966'f00f'55aaull; }

TEST(GraphRtl, AChain) {
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    EXPECT_EQ(against_rtl<GraphChainBank>(all_depths(seed, chain), one_clock<GraphChainBank>, threads(seed)),
              "");
  }
}

TEST(GraphRtl, AForkThatMeetsAgain) {
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    EXPECT_EQ(against_rtl<GraphForkJoinBank>(all_depths(seed, fork_meets_again), one_clock<GraphForkJoinBank>,
                                             threads(seed)),
              "");
  }
}

// Where the FIFO beside the window is too shallow, circuit and model stop after the same token.
TEST(GraphRtl, AJoinWithADelayOfTwoRows) {
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    EXPECT_EQ(against_rtl<GraphRowDelayBank>(all_depths(seed, row_delay), one_clock<GraphRowDelayBank>,
                                             threads(seed), kDepthForTwoRows),
              "");
  }
}

TEST(GraphRtl, AChainOverTwoClocks) {
  std::uint32_t seed = 0;
  for (const std::vector<std::int64_t>& periods :
       std::vector<std::vector<std::int64_t>>{{4, 10}, {10, 4}, {6, 5}, {5, 5}}) {
    ++seed;
    const auto make = [&](std::uint32_t depth, std::uint32_t s) { return two_clocks(depth, s, periods); };
    EXPECT_EQ(against_rtl<GraphTwoClocksBank>(all_depths(seed, make), two_clocks_of<GraphTwoClocksBank>,
                                              threads(seed)),
              "")
        << periods[0] << " and " << periods[1];
  }
}

// The chain that the benchmark runs, at full speed: when each token enters and leaves it.
template <class Top>
std::string chain8(std::uint32_t depth) {
  return in_child([&] {
    Top top;
    EdgeDates first, last;
    top.want_write = top.want_read = 1;
    for (std::int64_t cycle = 0; last.read.size() < kTokens; ++cycle) {
      top.want_write = first.written.size() < kTokens ? 1 : 0;
      top.eval();
      if (top.wrote) first.written.push_back(cycle);
      if (top.was_read) last.read.push_back(cycle);
      top.clk = 1;
      top.eval();
      top.clk = 0;
    }
    Graph graph;
    graph.nodes = {source(no_stalls(kTokens))};
    for (int i = 0; i < 8; ++i) graph.nodes.push_back(copy(1, 1));
    graph.nodes.push_back(sink(no_stalls(kTokens)));
    for (int i = 0; i < 9; ++i) graph.edges.push_back(fifo(i, i + 1, depth, FifoKind::kRegistered));
    const std::vector<EdgeDates> model = ModelSimulation(graph, 0).run();
    std::string text = top.disorder ? "the circuit loses, doubles or reorders tokens\n" : "";
    first.read = model.front().read;  // inside
    last.written = model.back().written;
    first.high_water = model.front().high_water;
    last.high_water = model.back().high_water;
    return text + differences({first, last}, {model.front(), model.back()});
  });
}

TEST(GraphRtl, TheChainOfTheBenchmark) {
  EXPECT_EQ(chain8<Chain8Depth2>(2), "");
  EXPECT_EQ(chain8<Chain8Depth16>(16), "");
  EXPECT_EQ(chain8<Chain8Depth64>(64), "");
}

}  // namespace graph_rtl_test
}  // namespace parallax::test
