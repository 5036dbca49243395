// SPDX-License-Identifier: Apache-2.0
// Every date of the model equals the reference's, on random graphs. PARALLAX_GRAPHS says on how many.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <iostream>
#include <sstream>

#include "tests/timing/graph_classes.hpp"
#include "tests/timing/in_child.hpp"
#include "tests/timing/model_simulation.hpp"
#include "tests/timing/random_graph.hpp"
#include "tests/timing/reference_simulation.hpp"

namespace parallax::test {
namespace random_graph_test {

constexpr char kStuck = '!';
constexpr std::array kKinds{FifoKind::kRegistered, FifoKind::kFirstWordFallThrough, FifoKind::kBlockRam,
                            FifoKind::kAsynchronous};

TEST(RandomGraph, EveryDateEqualsTheReference) {
  const char* asked = std::getenv("PARALLAX_GRAPHS");
  const int graphs = asked != nullptr ? std::atoi(asked) : 1000;
  rc::detail::TestParams params = rc::detail::configuration().testParams;
  params.maxSuccess = graphs;
  params.maxSize = 100;
  struct {
    int stuck = 0, crossing = 0, ahead = 0, again = 0, at_once = 0;
    std::array<int, kKinds.size()> kinds{};
  } met;
  const auto result = rc::detail::checkTestable(
      [&met] {
        const Graph graph = RandomGraph::make();
        const auto threads = *rc::gen::arbitrary<std::uint64_t>();
        // Small graphs: looks for periodic motion must come often to find any.
        const auto leap_interval = *rc::gen::element<std::uint64_t>(1, 10, 40, 1000000);
        std::string text = in_child([&] {
          const std::vector<EdgeDates> expected = ReferenceSimulation(graph).run();
          const std::string found =
              differences(expected, ModelSimulation(graph, threads, leap_interval).run());
          return (is_stuck(graph, expected) ? std::string(1, kStuck) : std::string()) + found;
        });
        const bool stuck = !text.empty() && text.front() == kStuck;
        if (stuck) text.erase(0, 1);
        met.stuck += stuck ? 1 : 0;
        met.crossing += crosses_clocks(graph) ? 1 : 0;
        met.ahead += looks_ahead(graph) ? 1 : 0;
        met.again += meets_again(graph) ? 1 : 0;
        met.at_once += passes_in_a_cycle(graph) ? 1 : 0;
        for (std::size_t i = 0; i < kKinds.size(); ++i) met.kinds[i] += has_kind(graph, kKinds[i]) ? 1 : 0;
        if (!text.empty()) {
          std::ostringstream description;
          description << text << "threads " << threads << " leap interval " << leap_interval << graph;
          RC_FAIL(description.str());
        }
      },
      rc::detail::TestMetadata{}, params);
  std::ostringstream report;
  rc::detail::printResultMessage(result, report);
  std::cout << report.str() << "\nof " << graphs << " graphs " << met.stuck << " deadlock, " << met.crossing
            << " cross clocks, " << met.ahead << " look ahead, " << met.again << " fork and meet again, "
            << met.at_once << " pass something in the same cycle\n";
  ASSERT_TRUE(result.template is<rc::detail::SuccessResult>()) << report.str();
  // A generator that no longer makes a kind of graph must not go unnoticed.
  if (graphs < 500) return;  // too few to tell
  EXPECT_GT(met.stuck, graphs / 30);
  EXPECT_LT(met.stuck, graphs / 2);
  EXPECT_GT(met.crossing, graphs / 16);
  EXPECT_GT(met.ahead, graphs / 4);
  EXPECT_GT(met.again, graphs / 6);
  EXPECT_GT(met.at_once, graphs / 4);
  for (const int kind : met.kinds) EXPECT_GT(kind, graphs / 8);
}

}  // namespace random_graph_test
}  // namespace parallax::test
