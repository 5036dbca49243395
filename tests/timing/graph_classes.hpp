// SPDX-License-Identifier: Apache-2.0
// What kind of graph a random one is, so that a test can tell that it meets enough of each.
#pragma once

#include <cstddef>
#include <set>
#include <vector>

#include "tests/timing/graph.hpp"

namespace parallax::test {

/// Whether two nodes of different clocks are connected.
inline bool crosses_clocks(const Graph& graph) {
  const auto period = [&](int node) {
    return graph.periods[static_cast<std::size_t>(graph.nodes[static_cast<std::size_t>(node)].clock)];
  };
  for (const GraphEdge& edge : graph.edges) {
    if (period(edge.from) != period(edge.to)) return true;
  }
  return false;
}

/// Whether some FIFO lets a token or a slot through in the same cycle.
inline bool passes_in_a_cycle(const Graph& graph) {
  for (const GraphEdge& edge : graph.edges) {
    if (edge.write_to_read == 0 || edge.read_to_write == 0) return true;
  }
  return false;
}

/// Whether a FIFO is named by its kind, a certain one.
inline bool has_kind(const Graph& graph, FifoKind kind) {
  for (const GraphEdge& edge : graph.edges) {
    if (edge.kind == kind) return true;
  }
  return false;
}

/// Whether some stage reads before it first writes.
inline bool looks_ahead(const Graph& graph) {
  for (const GraphNode& node : graph.nodes) {
    if (node.kind != GraphNode::Kind::kStage) continue;
    for (const GraphPart& part : node.parts) {
      if (part.repeat == 0 || part.phases.empty()) continue;
      bool writes = false;
      for (const Phase& phase : part.phases) writes = writes || phase.produce != 0;
      if (!writes && part.phases.front().consume != 0) return true;
      break;
    }
  }
  return false;
}

/// Whether some node is reached from another one on two ways.
inline bool meets_again(const Graph& graph) {
  std::vector<std::set<int>> above(graph.nodes.size());  // every node and what lies upstream of it
  for (std::size_t node = 0; node < graph.nodes.size(); ++node) {
    above[node].insert(static_cast<int>(node));
    for (const GraphEdge& edge : graph.edges) {  // nodes are numbered downstream
      if (edge.to != static_cast<int>(node)) continue;
      for (const int origin : above[static_cast<std::size_t>(edge.from)]) {
        if (!above[node].insert(origin).second) return true;
      }
    }
  }
  return false;
}

/// Whether a run of the graph got stuck: some sink has not read all it wants.
inline bool is_stuck(const Graph& graph, const std::vector<EdgeDates>& dates) {
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const GraphNode& reader = graph.nodes[static_cast<std::size_t>(graph.edges[e].to)];
    if (reader.kind == GraphNode::Kind::kSink && dates[e].read.size() < reader.stalls.size()) return true;
  }
  return false;
}

}  // namespace parallax::test
