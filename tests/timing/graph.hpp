// SPDX-License-Identifier: Apache-2.0
// A dataflow graph as plain data, for the model and for the reference to build from, put down as a data sheet
// reads:
//   graph.nodes = {source(no_stalls(8)), stage(1).times(8, {fires().reads(1).writes(1)}), sink({5, 0, 0})};
//   graph.edges = {link(0, 1).deep(4), link(1, 2).deep(2).of_kind(FifoKind::kBlockRam)};
#pragma once

#include <cstdint>
#include <ostream>
#include <utility>
#include <vector>

#include "tlm/schedule.hpp"
#include "tlm/stream_base.hpp"

namespace parallax::test {

/// Phases that are gone through `repeat` times.
struct GraphPart {
  std::uint64_t repeat = 1;
  std::vector<Phase> phases;
};

struct GraphNode {
  enum class Kind { kStage, kSource, kSink };
  Kind kind = Kind::kStage;
  int clock = 0;  ///< index into Graph::periods
  // Stage:
  std::uint32_t latency = 1;
  std::vector<GraphPart> parts;  ///< of one frame
  // Source and sink: the least number of cycles between tokens i-1 and i, minus one.
  std::vector<std::uint32_t> stalls;

  /// A stage then goes through these phases, so many times.
  GraphNode times(std::uint64_t repeat, std::vector<Phase> phases) const {
    GraphNode node = *this;
    node.parts.push_back({repeat, std::move(phases)});
    return node;
  }
  GraphNode on_clock(int index) const {
    GraphNode node = *this;
    node.clock = index;
    return node;
  }
};

inline GraphNode end_of(GraphNode::Kind kind, std::vector<std::uint32_t> stalls) {
  GraphNode node;
  node.kind = kind;
  node.stalls = std::move(stalls);
  return node;
}
inline GraphNode source(std::vector<std::uint32_t> stalls) {
  return end_of(GraphNode::Kind::kSource, std::move(stalls));
}
inline GraphNode sink(std::vector<std::uint32_t> stalls) {
  return end_of(GraphNode::Kind::kSink, std::move(stalls));
}
/// Of a source or sink that never rests.
inline std::vector<std::uint32_t> no_stalls(std::size_t tokens) {
  return std::vector<std::uint32_t>(tokens, 0);
}
/// A stage of this latency; what it does is said with GraphNode::times().
inline GraphNode stage(std::uint32_t latency) {
  GraphNode node;
  node.latency = latency;
  return node;
}
/// A stage that copies tokens, one in `interval` cycles.
inline GraphNode copying(std::uint32_t latency, std::uint64_t tokens, std::uint32_t interval = 1) {
  return stage(latency).times(tokens, {fires().reads(1).writes(1).every(interval)});
}

struct GraphEdge {
  int from = 0, from_port = 0;  ///< several edges from one port: a fork
  int to = 0, to_port = 0;
  std::uint32_t depth = 1;
  std::uint32_t write_to_read = 1;
  std::uint32_t read_to_write = 1;
  /// How the model is told of the offsets; the reference goes by the offsets themselves.
  FifoKind kind = FifoKind::kFree;
  SynchroniserStages synchroniser_stages{};
  std::uint32_t not_ready_cycles = 0;  ///< of the writer's clock, from 0 on

  /// Sets the kind and, from the tests' own table of rules, the offsets.
  GraphEdge& of_kind(FifoKind k, std::uint32_t stages = 2) { return of_kind(k, {stages, stages}); }
  GraphEdge& of_kind(FifoKind k, const SynchroniserStages& stages) {
    kind = k;
    synchroniser_stages = stages;
    write_to_read = k == FifoKind::kFirstWordFallThrough ? 0
                    : k == FifoKind::kBlockRam           ? 2
                    : k == FifoKind::kAsynchronous       ? stages.to_reader + 1
                                                         : 1;
    read_to_write = k == FifoKind::kAsynchronous ? stages.to_writer + 1 : 1;
    return *this;
  }
  /// Of kind kFree, then.
  GraphEdge& offsets(std::uint32_t to_read, std::uint32_t to_write) {
    write_to_read = to_read;
    read_to_write = to_write;
    return *this;
  }
  GraphEdge& ready_after(std::uint32_t cycles) {
    not_ready_cycles = cycles;
    return *this;
  }
  GraphEdge& deep(std::uint32_t tokens) {
    depth = tokens;
    return *this;
  }
  GraphEdge& out_of(int port) {
    from_port = port;
    return *this;
  }
  GraphEdge& into(int port) {
    to_port = port;
    return *this;
  }
};

/// From node to node, port 0 of each unless said otherwise.
inline GraphEdge link(int from, int to) {
  GraphEdge edge;
  edge.from = from;
  edge.to = to;
  return edge;
}

struct Graph {
  /// Clock periods in units of 1/30e9 s; divisors of 30e9 so that the frequency is a whole number.
  std::vector<std::int64_t> periods{10};
  std::vector<GraphNode> nodes;
  std::vector<GraphEdge> edges;
};

inline constexpr std::int64_t kUnitsPerSecond = 30'000'000'000;

/// Per edge, in cycles of the side: when each token was written and read.
struct EdgeDates {
  std::vector<std::int64_t> written;
  std::vector<std::int64_t> read;
  std::uint64_t high_water = 0;
};

inline Schedule schedule_of(const GraphNode& node) {
  Schedule schedule;
  for (const GraphPart& part : node.parts) schedule.repeat(part.repeat, part.phases);
  return schedule;
}

inline std::ostream& operator<<(std::ostream& out, const Graph& graph) {
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const GraphNode& n = graph.nodes[i];
    out << "\n  node " << i << " period " << graph.periods[static_cast<std::size_t>(n.clock)];
    if (n.kind != GraphNode::Kind::kStage) {
      out << (n.kind == GraphNode::Kind::kSource ? " source" : " sink") << ", stalls";
      for (const std::uint32_t stall : n.stalls) out << " " << stall;
      continue;
    }
    out << " latency " << n.latency;
    for (const GraphPart& part : n.parts) {
      out << ", " << part.repeat << " times";
      for (const Phase& p : part.phases) {
        out << " {" << p.count << " every " << p.interval << " in " << int{p.consume} << " out "
            << int{p.produce} << "}";
      }
    }
  }
  for (const GraphEdge& e : graph.edges) {
    out << "\n  edge " << e.from << "." << e.from_port << " -> " << e.to << "." << e.to_port << " depth "
        << e.depth << " +" << e.write_to_read << " +" << e.read_to_write << " " << name_of(e.kind)
        << ", not ready for " << e.not_ready_cycles;
  }
  return out;
}

}  // namespace parallax::test
