// SPDX-License-Identifier: Apache-2.0
// What must hold whatever the parameters are.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <sstream>

#include "tests/timing/in_child.hpp"
#include "tests/timing/model_simulation.hpp"
#include "tests/timing/random_graph.hpp"

namespace parallax::test {
namespace invariants_test {

using Dates = std::vector<std::vector<std::int64_t>>;  // two lists an edge: written, read

// A run in a process of its own; the dates come back as text.
Dates dates(const Graph& graph, std::uint64_t threads) {
  std::istringstream in(in_child([&] {
    std::ostringstream out;
    for (const EdgeDates& edge : ModelSimulation(graph, threads).run()) {
      for (const auto* side : {&edge.written, &edge.read}) {
        out << side->size();
        for (const std::int64_t date : *side) out << " " << date;
        out << "\n";
      }
    }
    return out.str();
  }));
  Dates all(2 * graph.edges.size());
  for (std::vector<std::int64_t>& side : all) {
    std::size_t size = 0;
    if (!(in >> size)) RC_FAIL("the simulation did not end");
    side.resize(size);
    for (std::int64_t& date : side) in >> date;
  }
  return all;
}

// A graph that gets stuck gets as far as before at least.
RC_GTEST_PROP(Invariants, ADeeperFifoDelaysNoToken, ()) {
  const Graph graph = RandomGraph::make();
  Graph deeper = graph;
  for (GraphEdge& edge : deeper.edges) {
    if (*rc::gen::inRange(0, 3) == 0) edge.depth += *rc::gen::inRange(1u, 50u);
  }
  const auto threads = *rc::gen::arbitrary<std::uint64_t>();
  const Dates before = dates(graph, threads);
  const Dates after = dates(deeper, threads);
  RC_CLASSIFY(before != after, "some dates are earlier");
  std::string text;
  for (std::size_t side = 0; side < before.size(); ++side) {
    for (std::size_t i = 0; i < before[side].size(); ++i) {
      if (i < after[side].size() && after[side][i] <= before[side][i]) continue;
      text +=
          fmt::format("edge {} {} token {}: {}, deeper {}\n", side / 2, side % 2 == 0 ? "written" : "read", i,
                      before[side][i], i < after[side].size() ? std::to_string(after[side][i]) : "never");
      break;
    }
  }
  if (!text.empty()) {
    std::ostringstream description;
    description << text << "threads " << threads << graph << deeper;
    RC_FAIL(description.str());
  }
}

}  // namespace invariants_test
}  // namespace parallax::test
