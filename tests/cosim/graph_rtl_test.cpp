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
namespace {

constexpr std::size_t kTokens = 300;
// The window writes its first token when it has read two rows of 12 and one more; what the fork wrote with
// these lies in the FIFO beside it.
constexpr std::uint32_t kDepthForTwoRows = 25;

GraphNode end(GraphNode::Kind kind, std::uint32_t seed, int clock = 0) {
  GraphNode node;
  node.kind = kind;
  node.clock = clock;
  node.stalls = rtl_stalls(kTokens, seed);
  return node;
}
GraphNode source(std::uint32_t seed) { return end(GraphNode::Kind::kSource, 2 * seed); }
GraphNode sink(std::uint32_t seed) { return end(GraphNode::Kind::kSink, 2 * seed + 1); }

GraphNode stage(std::uint32_t interval, std::uint32_t latency, int clock = 0) {
  GraphNode node;
  node.clock = clock;
  node.latency = latency;
  node.parts = {{kTokens, {{1, interval, 1, 1}}}};
  return node;
}

GraphEdge link(int from, int to, std::uint32_t depth, FifoKind kind, int to_port = 0,
               std::uint32_t stages = 2) {
  GraphEdge edge;
  edge.from = from;
  edge.to = to;
  edge.to_port = to_port;
  edge.depth = depth;
  return edge.of_kind(kind, stages);
}
GraphEdge write_when_read(int from, int to, std::uint32_t depth) {  // fifo_free with READ_TO_WRITE 0
  GraphEdge edge = link(from, to, depth, FifoKind::kFree);
  edge.read_to_write = 0;
  return edge;
}

// tests/rtl/graph_chain.sv
Graph chain(std::uint32_t depth, std::uint32_t seed) {
  Graph graph;
  graph.periods = {1};
  graph.nodes = {source(seed), stage(1, 3), stage(2, 0), stage(1, 1), stage(3, 5), sink(seed)};
  graph.edges = {link(0, 1, depth, FifoKind::kRegistered), link(1, 2, depth, FifoKind::kFirstWordFallThrough),
                 link(2, 3, depth, FifoKind::kBlockRam), write_when_read(3, 4, depth),
                 link(4, 5, depth, FifoKind::kRegistered)};
  return graph;
}

// tests/rtl/graph_fork_join.sv
Graph fork_join(const GraphNode& branch, std::uint32_t depth, std::uint32_t others, std::uint32_t seed) {
  GraphNode join = stage(1, 2);
  join.parts = {{kTokens, {{1, 1, 0b11, 1}}}};
  Graph graph;
  graph.periods = {1};
  graph.nodes = {source(seed), stage(1, 1), branch, join, sink(seed)};
  graph.edges = {link(0, 1, others, FifoKind::kFirstWordFallThrough),
                 link(1, 2, others, FifoKind::kRegistered), link(1, 3, depth, FifoKind::kBlockRam, 1),
                 link(2, 3, others, FifoKind::kFirstWordFallThrough), write_when_read(3, 4, others)};
  return graph;
}
Graph fork_meets_again(std::uint32_t depth, std::uint32_t seed) {
  return fork_join(stage(1, 6), depth, depth, seed);
}
Graph row_delay(std::uint32_t depth, std::uint32_t seed) {
  constexpr std::uint64_t kRow = 12;
  GraphNode window = stage(1, 2);
  window.parts = {{2 * kRow, {{1, 1, 1, 0}}}, {3 * kRow, {{1, 1, 1, 1}}}, {2 * kRow, {{1, 1, 0, 1}}}};
  return fork_join(window, depth, 4, seed);
}

// tests/rtl/graph_two_clocks.sv
Graph two_clocks(std::uint32_t depth, std::uint32_t seed, const std::vector<std::int64_t>& periods) {
  Graph graph;
  graph.periods = periods;
  graph.nodes = {source(seed), stage(1, 2), stage(2, 1, 1), stage(1, 0, 1), stage(1, 4), sink(seed)};
  graph.edges = {link(0, 1, depth, FifoKind::kRegistered), link(1, 2, depth, FifoKind::kAsynchronous),
                 link(2, 3, depth, FifoKind::kFirstWordFallThrough),
                 link(3, 4, depth, FifoKind::kAsynchronous, 0, 3), link(4, 5, depth, FifoKind::kBlockRam)};
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
    graph.nodes = {end(GraphNode::Kind::kSource, 0)};
    for (int i = 0; i < 8; ++i) graph.nodes.push_back(stage(1, 1));
    graph.nodes.push_back(end(GraphNode::Kind::kSink, 0));
    for (GraphNode& node : graph.nodes) std::fill(node.stalls.begin(), node.stalls.end(), 0u);
    for (int i = 0; i < 9; ++i) graph.edges.push_back(link(i, i + 1, depth, FifoKind::kRegistered));
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

}  // namespace
}  // namespace parallax::test
