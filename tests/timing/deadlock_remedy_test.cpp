// SPDX-License-Identifier: Apache-2.0
// The depths that free a stuck graph are enough, and the least that are: the model itself runs with them, and
// with one token less it does not.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <chrono>
#include <iostream>
#include <sstream>

#include "tests/timing/graph_classes.hpp"
#include "tests/timing/in_child.hpp"
#include "tests/timing/machine_bench.hpp"
#include "tests/timing/model_simulation.hpp"
#include "tests/timing/random_graph.hpp"
#include "tests/timing/random_pipeline.hpp"
#include "tlm/deadlock.hpp"

namespace parallax::test {
namespace {

constexpr std::uint32_t kDeep = 100'000;  // holds all tokens of these graphs

// Depths by index of the stream.
using Depths_ = std::map<std::size_t, std::uint32_t>;

struct Found {
  bool stuck = false;
  bool obstacle = false;
  Depths_ depths;
};

std::string text(bool stuck, const Dataflow& dataflow, const Remedy& remedy) {
  std::ostringstream out;
  out << stuck << " " << !remedy.obstacle.empty();
  for (const Remedy::Depth& depth : remedy.depths) {
    const auto& all = dataflow.streams();
    out << " " << std::find(all.begin(), all.end(), depth.stream) - all.begin() << " " << depth.tokens;
  }
  return out.str();
}

Found parse(const std::string& line) {
  Found found;
  std::istringstream in(line);
  std::size_t stream = 0;
  std::uint32_t tokens = 0;
  in >> found.stuck >> found.obstacle;
  while (in >> stream >> tokens) found.depths[stream] = tokens;
  return found;
}

// Frames that the sources bring.
std::uint64_t frames(const Graph& graph) {
  for (const GraphEdge& edge : graph.edges) {
    const GraphNode& from = graph.nodes[static_cast<std::size_t>(edge.from)];
    const GraphNode& to = graph.nodes[static_cast<std::size_t>(edge.to)];
    if (from.kind != GraphNode::Kind::kSource || to.kind != GraphNode::Kind::kStage) continue;
    return from.stalls.size() / schedule_of(to).consumed(static_cast<unsigned>(edge.to_port));
  }
  return 1;
}

Found simulate(Graph graph, std::uint64_t threads, const Depths_& depths = {}) {
  for (const auto& [edge, depth] : depths) graph.edges[edge].depth = depth;
  return parse(in_child([&] {
    ModelSimulation model(graph, threads);
    const bool stuck = is_stuck(graph, model.run());
    return text(stuck, model.dataflow(), smallest_remedy(model.dataflow(), frames(graph)));
  }));
}

struct Counts {
  int graphs = 0, stuck = 0, several = 0;
};

// What is claimed of `found`, where `run` simulates with other depths.
template <class Run>
void check(const Found& found, const std::vector<std::uint32_t>& now, const std::vector<std::int64_t>& widths,
           Counts& counts, const Run& run) {
  ++counts.graphs;
  RC_ASSERT(!found.obstacle);
  if (!found.stuck) {
    RC_ASSERT(found.depths.empty());
    return;
  }
  ++counts.stuck;
  RC_ASSERT(!found.depths.empty());
  RC_ASSERT(!run(found.depths).stuck);
  for (const auto& [stream, tokens] : found.depths) {
    Depths_ less = found.depths;
    RC_ASSERT(tokens > now[stream]);
    less[stream] = tokens - 1;
    RC_ASSERT(run(less).stuck);
  }
  const bool single = found.depths.size() == 1;
  counts.several += single ? 0 : 1;
  // No other stream alone is enough, or not for less.
  for (std::size_t other = 0; other < now.size(); ++other) {
    if (found.depths.count(other) != 0 && single) continue;
    std::uint32_t depth = kDeep;
    if (single) {
      const auto& [stream, tokens] = *found.depths.begin();
      const std::int64_t bits = (tokens - now[stream]) * widths[stream];
      depth = now[other] + static_cast<std::uint32_t>((bits - 1) / widths[other]);
    }
    if (depth > now[other]) RC_ASSERT(run({{other, depth}}).stuck);
  }
}

TEST(DeadlockRemedy, RandomGraphs) {
  Counts counts;
  rc::detail::TestParams params = rc::detail::configuration().testParams;
  params.maxSuccess = 10 * params.maxSuccess;
  const auto result = rc::detail::checkTestable(
      [&counts] {
        const Graph graph = RandomGraph::make();
        const auto threads = *rc::gen::arbitrary<std::uint64_t>();
        std::vector<std::uint32_t> now;
        for (const GraphEdge& edge : graph.edges) now.push_back(edge.depth);
        check(simulate(graph, threads), now, std::vector<std::int64_t>(now.size(), 8), counts,
              [&](const Depths_& depths) { return simulate(graph, threads, depths); });
      },
      rc::detail::TestMetadata{}, params);
  std::ostringstream report;
  rc::detail::printResultMessage(result, report);
  std::cout << report.str() << "\nof " << counts.graphs << " graphs " << counts.stuck << " deadlock, "
            << counts.several << " need more than one stream\n";
  ASSERT_TRUE(result.template is<rc::detail::SuccessResult>()) << report.str();
  if (counts.graphs < 500) return;
  EXPECT_GT(counts.stuck, counts.graphs / 30);
  EXPECT_GT(counts.several, 0);
}

}  // namespace
}  // namespace parallax::test
