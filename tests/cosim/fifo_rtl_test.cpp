// SPDX-License-Identifier: Apache-2.0
// The rule of every kind of FIFO against a circuit of that kind: all depths from 1 to 64, random stalls at
// both ends, and not one date that differs.
#include <FifoAsynchronousBank.h>
#include <FifoBank.h>
#include <gtest/gtest.h>

#include "tests/cosim/rtl_bench.hpp"

namespace parallax::test {
namespace fifo_rtl_test {

constexpr std::size_t kTokens = 300;
constexpr std::uint32_t kSeeds = 6;

// The bank's kinds, each between a source and a sink, for a lane of the bank.
Graph fifos(const std::vector<GraphEdge>& kinds, std::uint32_t depth, std::vector<std::int64_t> periods,
            std::uint32_t seed) {
  Graph graph;
  graph.periods = std::move(periods);
  for (const GraphEdge& kind : kinds) {
    const auto first = static_cast<int>(graph.nodes.size());
    GraphEdge edge = kind;
    edge.from = first;
    edge.to = first + 1;
    edge.depth = depth;
    graph.edges.push_back(edge);
    for (const bool first_end : {true, false}) {
      const std::vector<std::uint32_t> stalls = rtl_stalls(
          kTokens, seed * 100003u + depth * 1009u + static_cast<std::uint32_t>(graph.nodes.size()));
      graph.nodes.push_back(first_end ? source(stalls)
                                      : sink(stalls).on_clock(static_cast<int>(graph.periods.size()) - 1));
    }
  }
  return graph;
}

std::vector<Graph> all_depths(const std::vector<GraphEdge>& kinds, const std::vector<std::int64_t>& periods,
                              std::uint32_t seed) {
  std::vector<Graph> graphs;
  for (std::uint32_t depth = 1; depth <= 64; ++depth) graphs.push_back(fifos(kinds, depth, periods, seed));
  return graphs;
}

GraphEdge of_kind(FifoKind kind) { return GraphEdge{}.of_kind(kind); }
GraphEdge asynchronous(std::uint32_t to_reader, std::uint32_t to_writer) {
  return GraphEdge{}.of_kind(FifoKind::kAsynchronous, SynchroniserStages{to_reader, to_writer});
}
GraphEdge of_offsets(std::uint32_t write_to_read, std::uint32_t read_to_write) {
  return GraphEdge{}.offsets(write_to_read, read_to_write);
}

TEST(FifoRtl, EveryDateWithOneClock) {
  const std::vector<GraphEdge> kinds{of_kind(FifoKind::kRegistered),
                                     of_kind(FifoKind::kFirstWordFallThrough),
                                     of_kind(FifoKind::kBlockRam),
                                     of_offsets(1, 0),
                                     of_offsets(0, 0),
                                     of_offsets(3, 2),
                                     of_kind(FifoKind::kRegistered).ready_after(1),
                                     of_offsets(6, 1).ready_after(9)};
  for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
    const std::uint64_t threads = seed % 3 == 0 ? 0 : seed % 3 == 1 ? ~0ull : 0x5a3c'9966'f00f'55aaull;
    EXPECT_EQ(against_rtl<FifoBank>(all_depths(kinds, {1}, seed), one_clock<FifoBank>, threads), "")
        << "seed " << seed;
  }
}

TEST(FifoRtl, EveryDateBetweenTwoClocks) {
  const std::vector<GraphEdge> kinds{asynchronous(1, 1), asynchronous(2, 2), asynchronous(3, 3),
                                     asynchronous(6, 2), asynchronous(1, 4).ready_after(5)};
  std::uint32_t seed = 0;
  // Faster, slower, of a ratio that never repeats soon, and equal: then the edges coincide, and the
  // synchronisers are still there.
  for (const std::vector<std::int64_t>& periods :
       std::vector<std::vector<std::int64_t>>{{4, 10}, {10, 4}, {6, 5}, {15, 16}, {5, 5}}) {
    const std::uint64_t threads = ++seed % 2 == 0 ? 0 : 0x5a3c'9966'f00f'55aaull;
    EXPECT_EQ(against_rtl<FifoAsynchronousBank>(all_depths(kinds, periods, seed),
                                                two_clocks_of<FifoAsynchronousBank>, threads),
              "")
        << periods[0] << " to " << periods[1];
  }
}

}  // namespace fifo_rtl_test
}  // namespace parallax::test
