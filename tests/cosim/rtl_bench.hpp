// SPDX-License-Identifier: Apache-2.0
// Runs a bank of Verilated circuits between random stalls, notes every date, and runs the model of each
// beside it.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tests/timing/date_log.hpp"
#include "tests/timing/graph.hpp"
#include "tests/timing/graph_classes.hpp"
#include "tests/timing/in_child.hpp"
#include "tests/timing/model_simulation.hpp"

namespace parallax::test {

/// Stalls before each of `tokens` tokens, drawn from a seed: none, few long ones, many short ones, or both.
inline std::vector<std::uint32_t> rtl_stalls(std::size_t tokens, std::uint32_t seed) {
  std::vector<std::uint32_t> all(tokens, 0);
  std::uint32_t state = seed * 2654435761u + 1;
  const std::uint32_t mode = (state >> 16) % 4;
  for (std::uint32_t& stall : all) {
    state = state * 1664525u + 1013904223u;
    const std::uint32_t draw = state >> 20;
    stall = ((mode & 1u) != 0 ? draw % 3 : 0) + ((mode & 2u) != 0 && draw % 64 == 0 ? draw % 150 : 0);
  }
  return all;
}

template <class Top>
using ClocksOf = std::function<std::vector<CData*>(Top&)>;

template <class Top>
std::vector<CData*> one_clock(Top& top) {
  return {&top.clk};
}
template <class Top>
std::vector<CData*> two_clocks_of(Top& top) {
  return {&top.clk_0, &top.clk_1};
}

/// A bank that holds every circuit 64 times: lane i of it is bit i of the ports, and `graphs[i]` what it is.
template <class Top>
class RtlBench {
 public:
  /// All graphs have the same nodes and edges; the bank's source ports are their sources in order, likewise
  /// the sinks.
  explicit RtlBench(std::vector<Graph> graphs) : graphs_(std::move(graphs)) {
    const Graph& graph = graphs_.front();
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
      const auto from = static_cast<std::size_t>(graph.edges[e].from);
      const auto to = static_cast<std::size_t>(graph.edges[e].to);
      if (graph.nodes[from].kind == GraphNode::Kind::kSource)
        sources_.push_back({from, e, graph.nodes[from].clock});
      if (graph.nodes[to].kind == GraphNode::Kind::kSink) sinks_.push_back({to, e, graph.nodes[to].clock});
    }
    for (std::vector<End>* ends : {&sources_, &sinks_}) {
      for (End& end : *ends) end.lanes.resize(graphs_.size());
    }
  }

  /// Per lane and edge. `clocks_of(top)` are the bank's clock ports, in order.
  std::vector<std::vector<EdgeDates>> run(const ClocksOf<Top>& clocks_of) {
    const std::vector<CData*> clocks = clocks_of(top_);
    const Graph& graph = graphs_.front();
    std::vector<std::vector<EdgeDates>> dates(graphs_.size(), std::vector<EdgeDates>(graph.edges.size()));
    const std::int64_t slowest = *std::max_element(graph.periods.begin(), graph.periods.end());
    std::int64_t last_move = 0;
    // Longer than any stall, and any way through the circuit, takes.
    for (std::int64_t time = 0; time - last_move < 400 * slowest; ++time) {
      const auto ticks = [&](int clock) {
        return time % graph.periods[static_cast<std::size_t>(clock)] == 0;
      };
      const auto cycle = [&](int clock) { return time / graph.periods[static_cast<std::size_t>(clock)]; };
      if (!ticks(0) && (clocks.size() < 2 || !ticks(1))) continue;
      for (std::size_t i = 0; i < sources_.size(); ++i) {
        if (ticks(sources_[i].clock)) top_.want_write[i] = wanted(sources_[i], cycle(sources_[i].clock));
      }
      for (std::size_t i = 0; i < sinks_.size(); ++i) {
        if (ticks(sinks_[i].clock)) top_.want_read[i] = wanted(sinks_[i], cycle(sinks_[i].clock));
      }
      top_.eval();  // what is agreed on before the edge happens at it
      bool moved = false;
      for (std::size_t e = 0; e < graph.edges.size(); ++e) {
        const int writer = graph.nodes[static_cast<std::size_t>(graph.edges[e].from)].clock;
        const int reader = graph.nodes[static_cast<std::size_t>(graph.edges[e].to)].clock;
        for (std::size_t lane = 0; lane < graphs_.size(); ++lane) {
          if (ticks(writer) && ((top_.wrote[e] >> lane) & 1u)) {
            dates[lane][e].written.push_back(cycle(writer));
            moved = true;
          }
          if (ticks(reader) && ((top_.was_read[e] >> lane) & 1u)) {
            dates[lane][e].read.push_back(cycle(reader));
            moved = true;
          }
        }
      }
      if (moved) last_move = time;
      for (End& end : sources_) {
        if (ticks(end.clock)) moved_on(end, top_.wrote[end.edge], cycle(end.clock));
      }
      for (End& end : sinks_) {
        if (ticks(end.clock)) moved_on(end, top_.was_read[end.edge], cycle(end.clock));
      }
      for (std::size_t c = 0; c < clocks.size(); ++c) *clocks[c] = ticks(static_cast<int>(c)) ? 1 : 0;
      top_.eval();
      for (CData* clock : clocks) *clock = 0;
    }
    return dates;
  }

  /// Whether some token was lost, doubled or overtaken.
  bool disorder() const {
    return std::any_of(std::begin(top_.disorder), std::end(top_.disorder),
                       [](std::uint64_t lanes) { return lanes != 0; });
  }

 private:
  struct Lane {
    std::size_t tokens = 0;
    std::int64_t ready = 0;
  };
  struct End {  // source or sink
    std::size_t node, edge;
    int clock;
    std::vector<Lane> lanes{};
  };

  std::uint64_t wanted(End& end, std::int64_t cycle) const {
    std::uint64_t lanes = 0;
    for (std::size_t i = 0; i < graphs_.size(); ++i) {
      const std::vector<std::uint32_t>& stalls = graphs_[i].nodes[end.node].stalls;
      Lane& lane = end.lanes[i];
      if (lane.tokens == 0) lane.ready = stalls[0];
      if (lane.tokens < stalls.size() && cycle >= lane.ready) lanes |= std::uint64_t{1} << i;
    }
    return lanes;
  }
  void moved_on(End& end, std::uint64_t lanes, std::int64_t cycle) const {
    for (std::size_t i = 0; i < graphs_.size(); ++i) {
      if (((lanes >> i) & 1u) == 0) continue;
      const std::vector<std::uint32_t>& stalls = graphs_[i].nodes[end.node].stalls;
      Lane& lane = end.lanes[i];
      if (++lane.tokens < stalls.size()) lane.ready = cycle + 1 + stalls[lane.tokens];
    }
  }

  const std::vector<Graph> graphs_;
  Top top_;
  std::vector<End> sources_, sinks_;
};

/// All graphs, beside each other, as one.
inline Graph side_by_side(const std::vector<Graph>& graphs) {
  Graph all;
  all.periods = graphs.front().periods;
  for (const Graph& graph : graphs) {
    const int first = static_cast<int>(all.nodes.size());
    all.nodes.insert(all.nodes.end(), graph.nodes.begin(), graph.nodes.end());
    for (GraphEdge edge : graph.edges) {
      edge.from += first;
      edge.to += first;
      all.edges.push_back(edge);
    }
  }
  return all;
}

/// What differs between a bank and the model of it; empty when nothing does. `graphs`: one per lane, lane i
/// having depth i + 1. `threads`: as for ModelSimulation. With less than `least_depth` the circuit gets
/// stuck, else never.
template <class Top>
std::string against_rtl(const std::vector<Graph>& graphs, const ClocksOf<Top>& clocks_of,
                        std::uint64_t threads, std::uint32_t least_depth = 1) {
  return in_child([&] {
    RtlBench<Top> bench(graphs);
    const std::vector<std::vector<EdgeDates>> lanes = bench.run(clocks_of);
    const std::vector<EdgeDates> model = ModelSimulation(side_by_side(graphs), threads, 10).run();
    std::string text = bench.disorder() ? "the circuit loses, doubles or reorders tokens\n" : "";
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
      std::vector<EdgeDates> expected = lanes[lane];
      const auto first = model.begin() + static_cast<std::ptrdiff_t>(lane * expected.size());
      const std::vector<EdgeDates> actual(first, first + static_cast<std::ptrdiff_t>(expected.size()));
      // The circuits tell transfers only.
      for (std::size_t e = 0; e < expected.size(); ++e) expected[e].high_water = actual[e].high_water;
      const std::string found = differences(expected, actual);
      if (is_stuck(graphs[lane], expected) != (lane + 1 < least_depth)) {
        text += fmt::format("depth {}: the circuit gets stuck, or it should\n", lane + 1);
      }
      if (!found.empty()) text += fmt::format("depth {}: {}", lane + 1, found);
    }
    return text;
  });
}

}  // namespace parallax::test
