// SPDX-License-Identifier: Apache-2.0
#include "tlm/fork_depths.hpp"

#include <gtest/gtest.h>

namespace parallax {
namespace fork_depths_test {

// A graph by names: a stage is what it is written with, a stream two stages.
class Builder {
 public:
  std::size_t stage(const ForkGraph::Node& node = {}) {
    graph_.nodes.push_back(node);
    return graph_.nodes.size() - 1;
  }
  std::size_t stream(std::size_t from, std::size_t to, FifoOffsets offsets = {1, 1}) {
    graph_.edges.push_back({from, to, offsets});
    return graph_.edges.size() - 1;
  }
  std::size_t late_stream(std::size_t from, std::size_t to) {
    const std::size_t edge = stream(from, to);
    graph_.edges[edge].late = true;
    return edge;
  }
  std::size_t groups(std::size_t from, std::size_t to) {
    const std::size_t edge = stream(from, to);
    graph_.edges[edge].groups = true;
    return edge;
  }
  std::vector<std::uint64_t> depths() const { return fork_depths(graph_); }

 private:
  ForkGraph graph_;
};

constexpr ForkGraph::Node window(std::uint64_t look_ahead, std::uint64_t latency = 0) {
  return {look_ahead, latency, 0};
}

TEST(ForkDepths, AChainNeedsNothing) {
  Builder graph;
  const auto a = graph.stage();
  const auto b = graph.stage(window(100, 7));
  const auto c = graph.stage();
  graph.stream(a, b);
  graph.stream(b, c);
  EXPECT_EQ(graph.depths(), (std::vector<std::uint64_t>{0, 0}));
}

TEST(ForkDepths, AShortcutHoldsWhatTheWayThroughAWindowHolds) {
  Builder graph;
  const auto fork = graph.stage();
  const auto filter = graph.stage(window(100, 7));
  const auto join = graph.stage();
  const auto in = graph.stream(fork, filter);
  const auto out = graph.stream(filter, join);
  const auto shortcut = graph.stream(fork, join);
  const auto depths = graph.depths();
  // The window, its latency, one cycle through each FIFO, and as many for their slots' ways back.
  EXPECT_EQ(depths[shortcut], 100u + 7 + 2 + 2);
  EXPECT_EQ(depths[in], 0u);
  EXPECT_EQ(depths[out], 0u);
}

TEST(ForkDepths, WithoutALookAheadOnlyTheShortcutsOwnSlotHasToComeBack) {
  Builder graph;
  const auto fork = graph.stage();
  const auto copy = graph.stage(window(0, 7));
  const auto join = graph.stage();
  graph.stream(fork, copy);
  graph.stream(copy, join);
  const auto shortcut = graph.stream(fork, join, {3, 3});
  EXPECT_EQ(graph.depths()[shortcut], 7u + 2 + 3);
}

TEST(ForkDepths, StreamsSideBySideNeedNothing) {
  Builder graph;
  const auto fork = graph.stage();
  const auto join = graph.stage(window(50));
  graph.stream(fork, join);
  graph.stream(fork, join);
  EXPECT_EQ(graph.depths(), (std::vector<std::uint64_t>{0, 0}));
}

TEST(ForkDepths, TheSlowerFifoOfTwoSideBySideCounts) {
  Builder graph;
  const auto fork = graph.stage();
  const auto filter = graph.stage(window(10));
  const auto join = graph.stage();
  graph.stream(fork, filter);
  graph.stream(fork, filter, {3, 3});
  graph.stream(filter, join);
  const auto shortcut = graph.stream(fork, join);
  EXPECT_EQ(graph.depths()[shortcut], 10u + 3 + 1 + 3 + 1);
}

TEST(ForkDepths, OfTwoWindowsThePathOfTheSmallerOneHoldsTheDifferenceInItsLastStream) {
  Builder graph;
  const auto fork = graph.stage();
  const auto small = graph.stage(window(30, 5));
  const auto large = graph.stage(window(100, 7));
  const auto join = graph.stage();
  const auto to_small = graph.stream(fork, small);
  const auto to_large = graph.stream(fork, large);
  const auto of_small = graph.stream(small, join);
  const auto of_large = graph.stream(large, join);
  const auto depths = graph.depths();
  // Nothing is taken off for the latency and the FIFOs of the shorter path.
  EXPECT_EQ(depths[of_small], 100u - 30 + 7 + 2 + 1);
  EXPECT_EQ(depths[to_small], 0u);
  EXPECT_EQ(depths[to_large], 0u);
  EXPECT_EQ(depths[of_large], 0u);
}

TEST(ForkDepths, AJoinThatLooksAheadOnTheShortcutMakesTheOtherPathWait) {
  Builder graph;
  const auto fork = graph.stage();
  const auto filter = graph.stage(window(30, 5));
  const auto join = graph.stage(window(100));
  graph.stream(fork, filter);
  const auto late = graph.late_stream(filter, join);
  const auto shortcut = graph.stream(fork, join);
  const auto depths = graph.depths();
  EXPECT_EQ(depths[late], 100u - 30 + 1 + 1);
  EXPECT_EQ(depths[shortcut], 30u + 5 + 2 + 2);
}

TEST(ForkDepths, AJoinThatLooksAheadOnAllItsStreamsMakesNobodyWait) {
  Builder graph;
  const auto fork = graph.stage();
  const auto filter = graph.stage(window(30, 5));
  const auto join = graph.stage(window(100));
  graph.stream(fork, filter);
  const auto in = graph.stream(filter, join);
  const auto shortcut = graph.stream(fork, join);
  const auto depths = graph.depths();
  EXPECT_EQ(depths[in], 0u);
  EXPECT_EQ(depths[shortcut], 30u + 5 + 2 + 2);
}

TEST(ForkDepths, AJoinBehindAJoinBuildsOnWhatTheFirstShortcutHolds) {
  Builder graph;
  const auto fork = graph.stage();
  const auto filter = graph.stage(window(30, 5));
  const auto join = graph.stage(window(0, 2));
  const auto second = graph.stage(window(40, 3));
  const auto end = graph.stage();
  graph.stream(fork, filter);
  graph.stream(filter, join);
  const auto shortcut = graph.stream(fork, join);
  graph.stream(join, second);
  graph.stream(second, end);
  const auto longest = graph.stream(fork, end);
  const auto depths = graph.depths();
  EXPECT_EQ(depths[shortcut], 30u + 5 + 2 + 2);
  EXPECT_EQ(depths[longest], 39u + 2 + 40 + 3 + 2 + 2);
}

TEST(ForkDepths, PathsThatShareAStageForkThere) {
  Builder graph;
  const auto source = graph.stage();
  const auto filter = graph.stage(window(1000));
  const auto fork = graph.stage();
  const auto copy = graph.stage(window(0, 3));
  const auto join = graph.stage();
  graph.stream(source, filter);
  graph.stream(source, filter);
  graph.stream(filter, fork);
  graph.stream(fork, copy);
  graph.stream(copy, join);
  const auto shortcut = graph.stream(fork, join);
  EXPECT_EQ(graph.depths()[shortcut], 3u + 2 + 1);
}

TEST(ForkDepths, AGroupThatTheForkWritesIsPartlyThereWithTheTokenAtHand) {
  Builder graph;
  const auto fork = graph.stage({0, 0, 4});
  const auto gather = graph.stage({0, 16, 4});
  const auto join = graph.stage({0, 4, 4});
  const auto second = graph.stage({20, 6, 4});
  graph.groups(fork, gather);
  const auto first_shortcut = graph.groups(fork, join);
  const auto second_shortcut = graph.groups(fork, second);
  graph.stream(gather, join);
  graph.stream(join, second);
  const auto depths = graph.depths();
  EXPECT_EQ(depths[first_shortcut], 3u + 16 + 2 + 1);
  EXPECT_EQ(depths[second_shortcut], 22u + 4 + 4 + 1 + 1);
}

TEST(ForkDepths, LookAheadInPixelsIsAsManyGroupsOfTheForksTokens) {
  Builder graph;
  const auto fork = graph.stage({0, 0, 4});
  const auto gather = graph.stage({10, 16, 4});
  const auto join = graph.stage({0, 0, 4});
  graph.groups(fork, gather);
  graph.stream(gather, join);
  const auto shortcut = graph.groups(fork, join);
  EXPECT_EQ(graph.depths()[shortcut], 10u * 4 + 3 + 16 + 2 + 2);
}

}  // namespace fork_depths_test
}  // namespace parallax
