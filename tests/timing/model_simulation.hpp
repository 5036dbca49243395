// SPDX-License-Identifier: Apache-2.0
// A graph built from the model's own parts and run in the SystemC kernel. One simulation a process.
#pragma once

#include <fmt/format.h>

#include <memory>

#include "tests/timing/date_log.hpp"
#include "tests/timing/graph.hpp"
#include "tests/timing/graph_thread.hpp"
#include "tlm/stage.hpp"
#include "tlm/stream.hpp"

namespace parallax::test {

class GraphStage final : public Stage {
 public:
  GraphStage(const sc_core::sc_module_name& name, const ClockDomain& clock, Dataflow& dataflow,
             const GraphNode& node, std::uint64_t frames, int inputs, int outputs)
      : Stage(name, clock, dataflow, node.latency) {
    for (int i = 0; i < inputs; ++i)
      in.push_back(std::make_unique<StreamIn<int>>(fmt::format("in_{}", i).c_str()));
    for (int i = 0; i < outputs; ++i) {
      out.push_back(std::make_unique<StreamOut<int>>(fmt::format("out_{}", i).c_str()));
    }
    set_schedule(schedule_of(node));
    set_frame_limit(frames);
  }
  std::vector<std::unique_ptr<StreamIn<int>>> in;
  std::vector<std::unique_ptr<StreamOut<int>>> out;
};

class ModelSimulation {
 public:
  /// `threads`: sources and sinks are kernel threads where bit (node % 64) is set, else actors.
  /// `leap_interval`: as for Dataflow.
  ModelSimulation(const Graph& given, std::uint64_t threads,
                  std::uint64_t leap_interval = Dataflow::kLeapInterval)
      : graph_(given), dataflow_("dataflow", leap_interval), dates_(given.edges.size()) {
    const Graph& graph = graph_;
    for (std::size_t i = 0; i < graph.periods.size(); ++i) {
      clocks_.push_back(std::make_unique<ClockDomain>(fmt::format("clock_{}", i),
                                                      Hertz(kUnitsPerSecond / graph.periods[i])));
    }
    std::vector<int> inputs(graph.nodes.size(), 0);
    std::vector<int> outputs(graph.nodes.size(), 0);
    for (const GraphEdge& edge : graph.edges) {
      const auto from = static_cast<std::size_t>(edge.from);
      const auto to = static_cast<std::size_t>(edge.to);
      outputs[from] = std::max(outputs[from], edge.from_port + 1);
      inputs[to] = std::max(inputs[to], edge.to_port + 1);
      FifoConfig config;
      config.depth = edge.depth;
      config.kind = edge.kind;
      config.synchroniser_stages = edge.synchroniser_stages;
      config.not_ready_cycles = edge.not_ready_cycles;
      if (edge.kind == FifoKind::kFree) {
        config.write_to_read = edge.write_to_read;
        config.read_to_write = edge.read_to_write;
      }
      streams_.push_back(std::make_unique<Stream<int>>(fmt::format("s{}", streams_.size()).c_str(), dataflow_,
                                                       clock(graph.nodes[from]), clock(graph.nodes[to]),
                                                       config));
      log_.push_back(std::make_unique<DateLog>(dates_[streams_.size() - 1]));
      streams_.back()->add_listener(*log_.back());
    }
    stages_.resize(graph.nodes.size());
    threads_.resize(graph.nodes.size());
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
      const GraphNode& node = graph.nodes[i];
      const std::string name = fmt::format("n{}", i);
      if (node.kind != GraphNode::Kind::kStage && ((threads >> (i % 64)) & 1u)) {
        threads_[i] = std::make_unique<GraphThread<int>>(name.c_str(), clock(node), node);
      } else {
        stage_nodes_.push_back(node.kind == GraphNode::Kind::kStage ? node : as_stage(node));
        stages_[i] =
            std::make_unique<GraphStage>(name.c_str(), clock(node), dataflow_, stage_nodes_.back(),
                                         node.kind == GraphNode::Kind::kStage ? 0 : 1, inputs[i], outputs[i]);
      }
    }
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
      const GraphEdge& edge = graph.edges[e];
      const auto from = static_cast<std::size_t>(edge.from);
      const auto to = static_cast<std::size_t>(edge.to);
      (stages_[from] ? *stages_[from]->out[static_cast<std::size_t>(edge.from_port)]
                     : *threads_[from]->out)(*streams_[e]);
      (stages_[to] ? *stages_[to]->in[static_cast<std::size_t>(edge.to_port)]
                   : *threads_[to]->in)(*streams_[e]);
    }
  }

  std::vector<EdgeDates> run() {
    sc_core::sc_start();
    for (std::size_t i = 0; i < streams_.size(); ++i)
      dates_[i].high_water = streams_[i]->statistics().high_water;
    return dates_;
  }
  const Dataflow& dataflow() const { return dataflow_; }
  const StreamBase& stream(std::size_t i) const { return *streams_[i]; }
  const GraphStage& stage(std::size_t i) const { return *stages_[i]; }

 private:
  // A source or sink as the schedule of one frame.
  static GraphNode as_stage(const GraphNode& node) {
    const Phase token = node.kind == GraphNode::Kind::kSource ? fires().writes(1) : fires().reads(1);
    GraphNode as = test::stage(0).on_clock(node.clock);
    for (const std::uint32_t stall : node.stalls) as.parts.push_back({1, {idles(stall), token}});
    return as;
  }
  const ClockDomain& clock(const GraphNode& node) const {
    return *clocks_[static_cast<std::size_t>(node.clock)];
  }

  const Graph graph_;
  Dataflow dataflow_;
  std::vector<std::unique_ptr<ClockDomain>> clocks_;
  std::vector<EdgeDates> dates_;
  std::vector<std::unique_ptr<DateLog>> log_;
  std::vector<std::unique_ptr<Stream<int>>> streams_;
  std::deque<GraphNode> stage_nodes_;
  std::vector<std::unique_ptr<GraphStage>> stages_;
  std::vector<std::unique_ptr<GraphThread<int>>> threads_;
};

}  // namespace parallax::test
