// SPDX-License-Identifier: Apache-2.0
#include "tlm/fork_depths.hpp"

#include <algorithm>

namespace parallax {
namespace {

// From a fork to a stage, or to the end of a stream.
struct Path {
  std::uint64_t bridged = 0;     // tokens that a direct stream to a stage on it holds, if there is one
  std::uint64_t cycles = 0;      // since then: latencies, and ways through FIFOs
  std::uint64_t ahead = 0;       // since then: elements looked ahead
  std::uint64_t group = 0;       // since then: tokens of the largest group
  std::uint64_t back = 0;        // since then: cycles of the ways back through FIFOs
  std::uint64_t look_ahead = 0;  // elements, since the fork
  std::uint64_t stages = 0;      // passed since the fork
};

// The paths from one fork.
class Fork {
 public:
  Fork(const ForkGraph& graph, std::size_t fork)
      : graph_(graph), fork_(fork), longest_(graph.nodes.size()), common_(graph.nodes.size()) {
    const auto grouped = std::find_if(graph.edges.begin(), graph.edges.end(),
                                      [fork](const auto& edge) { return edge.from == fork && edge.groups; });
    if (grouped != graph.edges.end()) group_ = graph.nodes[fork].group;
    common_[fork].push_back(fork);
  }

  // Raises `depths` to what the streams into `node` need; nodes in order.
  void visit(std::size_t node, std::vector<std::uint64_t>& depths) {
    const std::vector<Arrival> all = arrivals(node);
    if (all.empty()) return;
    std::uint64_t bridged = 0;
    for (const Arrival& own : all) {
      std::uint64_t most = 0;
      for (const Arrival& other : all) most = std::max(most, needed(own, other));
      depths[own.edge] = std::max(depths[own.edge], most);
      if (own.path.stages == 0) bridged = std::max(bridged, most);
    }
    pass(node, all, bridged);
  }

 private:
  struct Arrival {  // at a stage, by one stream
    std::size_t edge = 0;
    Path path;
    std::uint64_t ahead = 0;  // that the stage reads this stream ahead of its others, elements
    std::uint64_t alike = 0;  // that it reads all of them ahead of what it writes
  };

  bool reached(std::size_t node) const { return !common_[node].empty(); }

  // Tokens of the fork's streams.
  std::uint64_t held(const Path& path) const {
    const bool at_hand = path.bridged == 0 && group_ > 0 && path.group > 0;
    return path.bridged + path.ahead * std::max<std::uint64_t>(group_, 1) + path.cycles + path.group -
           (at_hand ? 1 : 0);
  }

  std::vector<Arrival> arrivals(std::size_t node) const {
    std::vector<Arrival> all;
    for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
      const ForkGraph::Edge& edge = graph_.edges[i];
      if (edge.to != node || !reached(edge.from)) continue;
      Arrival arrival{i, longest_[edge.from], edge.late ? 0 : graph_.nodes[node].look_ahead, 0};
      if (edge.from != fork_) {
        const ForkGraph::Node& before = graph_.nodes[edge.from];
        arrival.path.cycles += before.latency;
        arrival.path.group = std::max(arrival.path.group, before.group);
        ++arrival.path.stages;
      }
      arrival.path.cycles += edge.offsets.write_to_read;
      arrival.path.back += edge.offsets.read_to_write;
      all.push_back(arrival);
    }
    const auto least = std::min_element(all.begin(), all.end(),
                                        [](const Arrival& a, const Arrival& b) { return a.ahead < b.ahead; });
    const std::uint64_t alike = all.empty() ? 0 : least->ahead;
    for (Arrival& arrival : all) {
      arrival.alike = alike;
      arrival.ahead -= alike;
    }
    return all;
  }

  bool share_a_stage(const Arrival& a, const Arrival& b) const {
    const std::vector<std::size_t>& of_a = common_[graph_.edges[a.edge].from];
    const std::vector<std::size_t>& of_b = common_[graph_.edges[b.edge].from];
    return std::any_of(of_a.begin(), of_a.end(), [&](std::size_t node) {
      return node != fork_ && std::find(of_b.begin(), of_b.end(), node) != of_b.end();
    });
  }

  // By the stream of `own`, so that it does not hold up `other`.
  std::uint64_t needed(const Arrival& own, const Arrival& other) const {
    Path longer = other.path;
    longer.ahead += other.ahead;
    longer.look_ahead += other.ahead;
    const std::uint64_t holds = own.path.look_ahead;
    const bool shorter =
        holds < longer.look_ahead || (holds == longer.look_ahead && own.path.stages < longer.stages);
    if (own.edge == other.edge || !shorter || share_a_stage(own, other)) return 0;
    const std::uint64_t own_back = graph_.edges[own.edge].offsets.read_to_write;
    const std::uint64_t beside = own.path.back - own_back;
    const std::uint64_t back = longer.look_ahead > 0 && longer.back > beside ? longer.back - beside : 0;
    return held(longer) - holds * std::max<std::uint64_t>(group_, 1) + std::max(back, own_back);
  }

  // The longest path to the stage, with what it looks ahead.
  void pass(std::size_t node, const std::vector<Arrival>& all, std::uint64_t bridged) {
    const std::uint64_t before = group_ > 0 ? group_ : 1;
    Path& longest = longest_[node];
    std::uint64_t length = 0;
    for (const Arrival& arrival : all) {
      Path path = arrival.path;
      path.ahead += arrival.ahead;
      path.look_ahead += arrival.ahead + arrival.alike;
      if (bridged > 0) {
        const std::uint64_t direct = path.ahead * before + path.cycles + path.back;
        const std::uint64_t tokens =
            path.stages > 0 ? bridged : (arrival.ahead > 0 ? std::max(direct, bridged) : 0);
        path = {tokens, 0, 0, 0, 0, path.look_ahead, path.stages};
      }
      path.ahead += arrival.alike;
      if (const std::uint64_t own = held(path) + path.back; own >= length) {
        length = own;
        longest = path;
      }
    }
    common_[node] = common_[graph_.edges[all.front().edge].from];
    for (const Arrival& arrival : all) {
      const std::vector<std::size_t>& of_other = common_[graph_.edges[arrival.edge].from];
      std::vector<std::size_t>& common = common_[node];
      common.erase(std::remove_if(common.begin(), common.end(),
                                  [&](std::size_t stage) {
                                    return std::find(of_other.begin(), of_other.end(), stage) ==
                                           of_other.end();
                                  }),
                   common.end());
    }
    common_[node].push_back(node);
  }

  const ForkGraph& graph_;
  const std::size_t fork_;
  std::uint64_t group_ = 0;                       // tokens of an element of its streams, if they are groups
  std::vector<Path> longest_;                     // by node, to it
  std::vector<std::vector<std::size_t>> common_;  // by node, the stages that all paths to it pass, and itself
};

}  // namespace

std::vector<std::uint64_t> fork_depths(const ForkGraph& graph) {
  std::vector<std::uint64_t> depths(graph.edges.size(), 0);
  for (std::size_t node = 0; node < graph.nodes.size(); ++node) {
    Fork fork(graph, node);
    for (std::size_t later = node + 1; later < graph.nodes.size(); ++later) fork.visit(later, depths);
  }
  return depths;
}

}  // namespace parallax
