// SPDX-License-Identifier: Apache-2.0
// Random graphs: chains, forks and joins that meet again, look-ahead in rows, changes of rate, depths 1 to
// 4096, all kinds of FIFO and other offsets, several clocks, random stalls at both ends. Some of them
// deadlock; that is part of what is compared.
#pragma once

#include <rapidcheck.h>

#include "tests/timing/graph.hpp"

namespace parallax::test {

class RandomGraph {
 public:
  /// `longer`: times as many pixels.
  static Graph make(int longer = 1) { return RandomGraph().build(longer); }

 private:
  struct Open {  // an output that has no reader yet
    int node, port;
    std::uint32_t rate;  // tokens a pixel
  };

  static int number(int low, int high) { return *rc::gen::inRange(low, high + 1); }

  Graph build(int longer) {
    width_ = number(1, 16);
    pixels_ = width_ * number(1, 12) * longer;
    frames_ = number(1, 2);
    const int clocks = number(0, 3) == 0 ? number(2, 3) : 1;
    graph_.periods.clear();
    for (int i = 0; i < clocks; ++i) graph_.periods.push_back(*rc::gen::element<std::int64_t>(6, 10, 15, 4));
    const int sources = number(1, 2);
    for (int i = 0; i < sources; ++i) source();
    const int stages = number(1, 7);
    for (int i = 0; i < stages; ++i) stage();
    while (!open_.empty()) sink();
    return graph_;
  }

  int random_clock() const { return number(0, static_cast<int>(graph_.periods.size()) - 1); }

  std::vector<std::uint32_t> stalls(std::uint32_t tokens) const {
    std::vector<std::uint32_t> all(tokens, 0);
    const int mode = number(0, 3);
    if (mode == 0) return all;
    // A seed and a hash keep the number of choices, and with it the time to shrink, small.
    std::uint32_t state = *rc::gen::inRange(1u, 1000000u);
    for (std::uint32_t& stall : all) {
      state = state * 1664525u + 1013904223u;
      const std::uint32_t draw = state >> 20;
      stall = mode == 1 ? draw % 2 : mode == 2 ? (draw % 8 == 0 ? draw % 23 : 0) : draw % 5;
    }
    return all;
  }

  void source() {
    const int clock = random_clock();
    graph_.nodes.push_back(
        test::source(stalls(static_cast<std::uint32_t>(pixels_ * frames_))).on_clock(clock));
    open_output(0, 1);
  }

  void sink() {
    const Open from = take();
    const int clock = random_clock();
    graph_.nodes.push_back(
        test::sink(stalls(static_cast<std::uint32_t>(pixels_ * frames_) * from.rate)).on_clock(clock));
    connect(from, 0);
  }

  void open_output(int port, std::uint32_t rate) {
    const int forks = number(0, 3) == 0 ? 2 : 1;
    for (int i = 0; i < forks; ++i) open_.push_back({static_cast<int>(graph_.nodes.size()) - 1, port, rate});
  }

  Open take() {
    const auto i = static_cast<std::ptrdiff_t>(number(0, static_cast<int>(open_.size()) - 1));
    const Open from = open_[static_cast<std::size_t>(i)];
    open_.erase(open_.begin() + i);
    return from;
  }

  void connect(const Open& from, int to_port) {
    GraphEdge edge;
    edge.from = from.node;
    edge.from_port = from.port;
    edge.to = static_cast<int>(graph_.nodes.size()) - 1;
    edge.to_port = to_port;
    switch (number(0, 4)) {
      case 0:
        edge.depth = 1;
        break;
      case 1:
        edge.depth = static_cast<std::uint32_t>(number(2, 4));
        break;
      case 2:
        edge.depth = static_cast<std::uint32_t>(number(1, 40));
        break;
      case 3:
        edge.depth = static_cast<std::uint32_t>(number(1, 400));
        break;
      default:
        edge.depth = static_cast<std::uint32_t>(number(1, 4096));
        break;
    }
    fifo(edge);
    graph_.edges.push_back(edge);
  }

  // Half of the FIFOs are plain, a quarter of a kind, a quarter described by offsets.
  void fifo(GraphEdge& edge) const {
    const auto clock = [this](int node) { return graph_.nodes[static_cast<std::size_t>(node)].clock; };
    const bool one_clock = clock(edge.from) == clock(edge.to);
    switch (number(0, 3)) {
      case 0:
        edge.of_kind(one_clock ? *rc::gen::element(FifoKind::kRegistered, FifoKind::kFirstWordFallThrough,
                                                   FifoKind::kBlockRam, FifoKind::kAsynchronous)
                               : FifoKind::kAsynchronous,
                     SynchroniserStages{static_cast<std::uint32_t>(number(1, 4)),
                                        static_cast<std::uint32_t>(number(1, 4))});
        break;
      case 1: {
        const int least = one_clock ? 0 : 1;
        const int most =
            number(0, 1) == 0 ? 1 : 4;  // offsets of 0 on several edges at a time shall be no rarity
        edge.write_to_read = static_cast<std::uint32_t>(number(least, most));
        edge.read_to_write = static_cast<std::uint32_t>(number(least, most));
        break;
      }
      default:
        break;
    }
    if (number(0, 5) == 0) edge.ready_after(static_cast<std::uint32_t>(number(1, 20)));
  }

  // A stage that reads 1 to 3 open outputs and writes 1 or 2, with its own rates and look-ahead.
  void stage() {
    GraphNode node;
    node.clock = random_clock();
    node.latency = static_cast<std::uint32_t>(number(0, 2) == 0 ? number(0, 40) : number(0, 3));
    graph_.nodes.push_back(node);

    const int inputs = std::min<int>(number(1, 3), static_cast<int>(open_.size()));
    std::vector<std::uint32_t> in_rates;
    for (int i = 0; i < inputs; ++i) {
      const Open from = take();
      in_rates.push_back(from.rate);
      connect(from, i);
    }
    const int outputs = number(0, 3) == 0 ? 2 : 1;
    std::vector<std::uint32_t> out_rates;
    for (int i = 0; i < outputs; ++i) {
      out_rates.push_back(static_cast<std::uint32_t>(number(0, 3) == 0 ? number(1, 4) : 1));
      open_output(i, out_rates.back());
    }

    std::uint32_t beats = 1;
    for (const std::uint32_t rate : in_rates) beats = std::max(beats, rate);
    for (const std::uint32_t rate : out_rates) beats = std::max(beats, rate);
    const auto interval = static_cast<std::uint32_t>(number(0, 3) == 0 ? number(2, 5) : 1);
    const auto pixel = [&](bool reads, bool writes) {  // inputs in the first beats, outputs in the last ones
      std::vector<Phase> phases;
      for (std::uint32_t beat = 0; beat < beats; ++beat) {
        unsigned consume = 0;
        unsigned produce = 0;
        for (std::size_t i = 0; i < in_rates.size(); ++i) {
          if (reads && beat < in_rates[i]) consume |= 1u << i;
        }
        for (std::size_t i = 0; i < out_rates.size(); ++i) {
          if (writes && beat >= beats - out_rates[i]) produce |= 1u << i;
        }
        if ((consume | produce) != 0)
          phases.push_back(fires().reads(consume).writes(produce).every(interval));
      }
      return phases;
    };
    const int ahead = number(0, 2) == 0 ? std::min(pixels_, number(0, 4) * width_ + number(0, 3)) : 0;
    std::vector<GraphPart> parts;
    parts.push_back({static_cast<std::uint64_t>(ahead), pixel(true, false)});
    const int row_overhead = number(0, 4) == 0 ? number(1, 9) : 0;
    for (int done = ahead; done < pixels_; done += width_) {
      parts.push_back({static_cast<std::uint64_t>(std::min(width_, pixels_ - done)), pixel(true, true)});
      if (row_overhead > 0) parts.push_back({1, {idles(static_cast<std::uint32_t>(row_overhead))}});
    }
    parts.push_back({static_cast<std::uint64_t>(ahead), pixel(false, true)});
    graph_.nodes.back().parts = parts;
  }

  Graph graph_;
  std::vector<Open> open_;
  int width_ = 1;
  int pixels_ = 1;
  int frames_ = 1;
};

}  // namespace parallax::test
