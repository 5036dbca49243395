// SPDX-License-Identifier: Apache-2.0
// The reference for every date: a plain simulation that goes through time edge by edge and moves one token at
// a time through explicit registers, as the circuit does. It shares no code with the model.
//
// A FIFO may let a token or a slot through in the same cycle. So the nodes are gone through, at one time,
// until none moves any more: what a combinational path would settle to. A move never takes away what another
// one needs, each token and each slot having one taker, so the end does not depend on the order of the
// nodes. Nodes that wait for each other within one cycle do not move.
#pragma once

#include <algorithm>
#include <deque>
#include <optional>

#include "tests/timing/graph.hpp"

namespace parallax::test {

class ReferenceSimulation {
 public:
  explicit ReferenceSimulation(const Graph& graph) : graph_(graph), fifos_(graph.edges.size()) {
    for (std::size_t i = 0; i < graph.nodes.size(); ++i)
      states_.emplace_back(unrolled(graph.nodes[i]), graph.nodes[i]);
  }

  /// Runs until nothing has moved for longer than anything can take: all is done, or deadlocked.
  std::vector<EdgeDates> run() {
    std::int64_t longest = 1;  // no idle gap is longer than this many edges of the slowest clock
    for (const GraphNode& node : graph_.nodes) {
      std::int64_t gap = node.latency + 2;
      for (const GraphPart& part : node.parts) {
        for (const Phase& p : part.phases) {
          gap += std::int64_t{p.interval} * (p.consume == 0 && p.produce == 0 ? p.count : 1);
        }
      }
      for (const std::uint32_t stall : node.stalls) gap = std::max<std::int64_t>(gap, stall + 2);
      longest += gap;
    }
    for (const GraphEdge& edge : graph_.edges)
      longest += edge.write_to_read + edge.read_to_write + edge.not_ready_cycles;
    longest *= *std::max_element(graph_.periods.begin(), graph_.periods.end());

    const bool combinational = std::any_of(graph_.edges.begin(), graph_.edges.end(), [](const GraphEdge& e) {
      return e.write_to_read == 0 || e.read_to_write == 0;
    });
    std::int64_t last_move = 0;
    for (std::int64_t time = 0; time - last_move <= longest; ++time) {
      for (bool again = true; again;) {
        bool moved = false;
        for (std::size_t i = 0; i < graph_.nodes.size(); ++i) {
          const std::int64_t period = graph_.periods[static_cast<std::size_t>(graph_.nodes[i].clock)];
          if (time % period == 0) moved |= edge(i, time, time / period);
        }
        if (moved) last_move = time;
        again = moved && combinational;
      }
      for (std::size_t e = 0; e < fifos_.size(); ++e) count_tokens(e, time);
    }
    std::vector<EdgeDates> dates;
    for (const Fifo& fifo : fifos_) dates.push_back(fifo.dates);
    return dates;
  }

 private:
  struct Fifo {
    std::deque<std::int64_t> held;   // times of writing of the tokens not read
    std::deque<std::int64_t> freed;  // times of reading whose slot is not writable yet
    bool written = false;            // in the present cycle
    EdgeDates dates;
  };
  struct Firing {
    unsigned consume, produce;
    std::int64_t interval;
  };
  struct Moving {  // a firing on its way through the pipeline
    unsigned produce;
    std::int64_t arrived;  // in its register; it moves on in a later cycle
  };
  struct State {
    State(std::vector<Firing> f, const GraphNode& node) : firings(std::move(f)), registers(node.latency) {}
    std::vector<Firing> firings;  // of one frame
    std::size_t next = 0;
    std::int64_t busy_until = 0;
    std::vector<std::optional<Moving>> registers;  // the pipeline
    std::size_t tokens = 0;                        // source and sink
    std::int64_t ready = 0;
  };

  static std::vector<Firing> unrolled(const GraphNode& node) {
    std::vector<Firing> all;
    for (const GraphPart& part : node.parts) {
      for (std::uint64_t pass = 0; pass < part.repeat; ++pass) {
        for (const Phase& p : part.phases) {
          for (std::uint32_t i = 0; i < p.count; ++i) all.push_back({p.consume, p.produce, p.interval});
        }
      }
    }
    return all;
  }

  std::int64_t period_of(int node) const {
    return graph_.periods[static_cast<std::size_t>(graph_.nodes[static_cast<std::size_t>(node)].clock)];
  }
  // How many edges of a clock lie in (after, until].
  static std::int64_t edges_between(std::int64_t after, std::int64_t until, std::int64_t period) {
    std::int64_t count = 0;
    for (std::int64_t t = (after / period + 1) * period; t <= until && count < 64; t += period) ++count;
    return count;
  }
  bool has_token(std::size_t e, std::int64_t time) const {
    const GraphEdge& edge = graph_.edges[e];
    return !fifos_[e].held.empty() &&
           edges_between(fifos_[e].held.front(), time, period_of(edge.to)) >= edge.write_to_read;
  }
  bool has_room(std::size_t e, std::int64_t time) {
    const GraphEdge& edge = graph_.edges[e];
    if (time / period_of(edge.from) < edge.not_ready_cycles) return false;
    auto& freed = fifos_[e].freed;
    while (!freed.empty() && edges_between(freed.front(), time, period_of(edge.from)) >= edge.read_to_write) {
      freed.pop_front();
    }
    return fifos_[e].held.size() + freed.size() < edge.depth;
  }
  bool inputs_ready(int node, unsigned mask, std::int64_t time) const {
    for (std::size_t e = 0; e < graph_.edges.size(); ++e) {
      if (graph_.edges[e].to == node && ((mask >> graph_.edges[e].to_port) & 1u) && !has_token(e, time))
        return false;
    }
    return true;
  }
  bool outputs_ready(int node, unsigned mask, std::int64_t time) {
    for (std::size_t e = 0; e < graph_.edges.size(); ++e) {
      if (graph_.edges[e].from == node && ((mask >> graph_.edges[e].from_port) & 1u) && !has_room(e, time))
        return false;
    }
    return true;
  }
  void read(int node, unsigned mask, std::int64_t time, std::int64_t cycle) {
    for (std::size_t e = 0; e < graph_.edges.size(); ++e) {
      if (graph_.edges[e].to != node || !((mask >> graph_.edges[e].to_port) & 1u)) continue;
      fifos_[e].held.pop_front();
      fifos_[e].freed.push_back(time);
      fifos_[e].dates.read.push_back(cycle);
    }
  }
  void write(int node, unsigned mask, std::int64_t time, std::int64_t cycle) {
    for (std::size_t e = 0; e < graph_.edges.size(); ++e) {
      if (graph_.edges[e].from != node || !((mask >> graph_.edges[e].from_port) & 1u)) continue;
      fifos_[e].held.push_back(time);
      fifos_[e].dates.written.push_back(cycle);
      fifos_[e].written = true;
    }
  }
  // At the end of a cycle. A slot that was read in it still counts where it is free from a later edge on
  // only.
  void count_tokens(std::size_t e, std::int64_t time) {
    Fifo& fifo = fifos_[e];
    if (!fifo.written) return;
    fifo.written = false;
    has_room(e, time);  // forgets the slots that are free by now
    fifo.dates.high_water = std::max(fifo.dates.high_water, fifo.held.size() + fifo.freed.size());
  }

  // What one node can do at one clock edge and has not done yet.
  bool edge(std::size_t i, std::int64_t time, std::int64_t cycle) {
    const GraphNode& node = graph_.nodes[i];
    const int id = static_cast<int>(i);
    State& s = states_[i];
    if (node.kind != GraphNode::Kind::kStage) {
      if (s.tokens == node.stalls.size()) return false;
      if (s.tokens == 0 && cycle == 0) s.ready = node.stalls[0];
      if (cycle < s.ready) return false;
      const bool source = node.kind == GraphNode::Kind::kSource;
      if (source ? !outputs_ready(id, 1, time) : !inputs_ready(id, 1, time)) return false;
      source ? write(id, 1, time, cycle) : read(id, 1, time, cycle);
      if (++s.tokens < node.stalls.size()) s.ready = cycle + 1 + node.stalls[s.tokens];
      return true;
    }
    bool moved = false;
    // The last register empties into the FIFOs, then each register moves into a free one after it.
    if (!s.registers.empty()) {
      std::optional<Moving>& last = s.registers.back();
      if (last && last->arrived < cycle && outputs_ready(id, last->produce, time)) {
        write(id, last->produce, time, cycle);
        last.reset();
        moved = true;
      }
      for (std::size_t r = s.registers.size() - 1; r > 0; --r) {
        if (!s.registers[r] && s.registers[r - 1] && s.registers[r - 1]->arrived < cycle) {
          std::swap(s.registers[r], s.registers[r - 1]);
          s.registers[r]->arrived = cycle;
          moved = true;
        }
      }
    }
    const Firing& firing = s.firings[s.next];
    const bool direct = s.registers.empty();
    if (cycle >= s.busy_until && inputs_ready(id, firing.consume, time) &&
        (firing.produce == 0 || (direct ? outputs_ready(id, firing.produce, time) : !s.registers.front()))) {
      read(id, firing.consume, time, cycle);
      if (firing.produce != 0) {
        if (direct) {
          write(id, firing.produce, time, cycle);
        } else {
          s.registers.front() = Moving{firing.produce, cycle};
        }
      }
      s.busy_until = cycle + firing.interval;
      s.next = (s.next + 1) % s.firings.size();
      moved = moved || firing.consume != 0 || firing.produce != 0;
    }
    return moved;
  }

  const Graph& graph_;
  std::vector<Fifo> fifos_;
  std::vector<State> states_;
};

}  // namespace parallax::test
