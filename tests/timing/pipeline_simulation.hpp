// SPDX-License-Identifier: Apache-2.0
// The machine's pipeline between four threads that bring and take bursts, and the graph that it is.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "platform/machine/pipeline.hpp"
#include "tests/timing/date_log.hpp"
#include "tests/timing/graph.hpp"
#include "tests/timing/graph_thread.hpp"
#include "tlm/dma.hpp"

namespace parallax::test {

/// A pipeline and what its four ends do: for each burst, the cycles that the thread waits before it.
struct PipelineCase {
  MachineConfig config;
  EncodedMap map;  ///< cut for the tiles
  TilePlan tiles;
  std::vector<std::uint32_t> left, right, map_stalls, output;
  std::vector<std::uint32_t> rows_kept, rows_returned, frame_kept, frame_returned;

  int height() const { return map.height / static_cast<int>(tiles.tiles.size()); }
};

/// Bursts of one frame at the four ends.
struct PipelineBursts {
  explicit PipelineBursts(const PipelineCase& c)
      : map(burst_count(c.map.bytes.size(), Bytes(c.config.dma.map.burst_bytes))) {
    const auto rows = static_cast<std::uint64_t>(c.height());
    const bool apart = c.tiles.tiles.size() > 1;
    const auto bursts = [&](std::uint64_t row_bytes, const DmaPortConfig& port) {
      const Bytes burst(port.burst_bytes);
      return apart ? rows * burst_count(row_bytes, burst) : burst_count(rows * row_bytes, burst);
    };
    for (const Tile& tile : c.tiles.tiles) {
      left += bursts(static_cast<std::uint64_t>(c.tiles.width), c.config.dma.left);
      right += bursts(static_cast<std::uint64_t>(c.tiles.width), c.config.dma.right);
      output += bursts(OutputPacking::row_bytes(tile.keep_end - tile.keep_begin, c.config.link.output_left()),
                       c.config.dma.output);
    }
    const MatcherStore store = matcher_store(c.config, c.tiles.width, c.height());
    for (const StoreLayout::Pass& pass : store.rows.passes)
      kept_rows += pass.rows * store.rows.row_bursts(pass);
    const StoreLayout::Pass& pass = store.frame.passes.front();
    kept_frame = pass.rows * store.frame.row_bursts(pass);
    kept_rows *= c.tiles.tiles.size();
    kept_frame *= c.tiles.tiles.size();
  }
  std::uint64_t left = 0, right = 0, map, output = 0, kept_rows = 0, kept_frame = 0;
};

class PipelineSimulation {
 public:
  explicit PipelineSimulation(const PipelineCase& c, std::uint64_t leap_interval = Dataflow::kLeapInterval)
      : case_(c),
        clock_("core", Hertz(c.config.clocks.core_hz)),
        dataflow_("dataflow", leap_interval),
        pipeline_("pipeline", case_.config, case_.map, c.tiles,
                  {clock_, dataflow_, c.tiles.width, c.height(), case_.config.timing.overlap_frames,
                   case_.config.timing.pixels_per_token}),
        left_node_(source(c.left)),
        right_node_(source(c.right)),
        map_node_(source(c.map_stalls)),
        output_node_(sink(c.output)),
        left_("left", clock_, left_node_),
        right_("right", clock_, right_node_),
        map_("map", clock_, map_node_),
        output_("output", clock_, output_node_) {
    pipeline_.bind(*left_.out, *right_.out, *map_.out, *output_.in);
    if (pipeline_.store().keeps_rows()) {
      rows_ = std::make_unique<StoreEnds>("rows", clock_, c.rows_kept, c.rows_returned);
      pipeline_.bind_rows(*rows_->kept.in, *rows_->returned.out);
    }
    if (pipeline_.store().keeps_frame()) {
      frame_ = std::make_unique<StoreEnds>("frame", clock_, c.frame_kept, c.frame_returned);
      pipeline_.bind_frame(*frame_->kept.in, *frame_->returned.out);
    }
    const std::vector<StreamBase*>& streams = dataflow_.streams();
    dates_.resize(streams.size());
    for (std::size_t i = 0; i < streams.size(); ++i) {
      logs_.push_back(std::make_unique<DateLog>(dates_[i]));
      streams[i]->add_listener(*logs_.back());
    }
  }

  std::vector<EdgeDates> run() {
    sc_core::sc_start();
    for (std::size_t i = 0; i < dates_.size(); ++i) {
      dates_[i].high_water = dataflow_.streams()[i]->statistics().high_water;
    }
    return dates_;
  }
  const std::vector<EdgeDates>& dates() const { return dates_; }
  const Dataflow& dataflow() const { return dataflow_; }

  /// The graph that the pipeline is, edge i being stream i; after run().
  Graph graph() const {
    Graph graph;
    graph.periods = {1};
    std::map<const StreamBase*, GraphEdge> edges;
    for (const StageInfo& info : pipeline_.stages()) {
      const int id = static_cast<int>(graph.nodes.size());
      graph.nodes.push_back(node(*info.stage));
      for (unsigned port = 0; port < Stage::kMaxPorts; ++port) {
        for (const StreamBase* stream : info.stage->input_streams(port)) {
          edges[stream].to = id;
          edges[stream].to_port = static_cast<int>(port);
        }
        for (const StreamBase* stream : info.stage->output_streams(port)) {
          edges[stream].from = id;
          edges[stream].from_port = static_cast<int>(port);
        }
      }
    }
    const auto add_end = [&](const GraphNode& end, const GraphThread<std::uint8_t>& thread) {
      const bool source = end.kind == GraphNode::Kind::kSource;
      for (const StreamBase* stream : dataflow_.streams()) {
        if ((source ? stream->writer_name() : stream->reader_name()) == thread.name()) {
          (source ? edges[stream].from : edges[stream].to) = static_cast<int>(graph.nodes.size());
        }
      }
      graph.nodes.push_back(end);
    };
    add_end(left_node_, left_);
    add_end(right_node_, right_);
    add_end(map_node_, map_);
    add_end(output_node_, output_);
    for (const StoreEnds* ends : {rows_.get(), frame_.get()}) {
      if (ends == nullptr) continue;
      add_end(ends->kept_node, ends->kept);
      add_end(ends->returned_node, ends->returned);
    }
    for (const StreamBase* stream : dataflow_.streams()) {
      const FifoConfig& fifo = stream->config();
      edges[stream].depth = fifo.depth;
      edges[stream].of_kind(fifo.kind, fifo.synchroniser_stages);
      if (fifo.kind == FifoKind::kFree) edges[stream].offsets(fifo.write_to_read, fifo.read_to_write);
      edges[stream].ready_after(fifo.not_ready_cycles);
      graph.edges.push_back(edges[stream]);
    }
    return graph;
  }

 private:
  static GraphNode node(const Stage& stage) {
    GraphNode node;
    node.latency = stage.latency();
    const Schedule& schedule = stage.schedule();
    for (const Schedule::Segment& segment : schedule.segments()) {
      GraphPart part;
      part.repeat = segment.repeat;
      for (std::uint32_t i = 0; i < segment.phase_count; ++i) {
        part.phases.push_back(schedule.phases()[segment.first_phase + i]);
      }
      node.parts.push_back(part);
    }
    return node;
  }

  struct StoreEnds {
    StoreEnds(const std::string& what, const ClockDomain& clock,
              const std::vector<std::uint32_t>& kept_stalls,
              const std::vector<std::uint32_t>& returned_stalls)
        : kept_node(sink(kept_stalls)),
          returned_node(source(returned_stalls)),
          kept((what + "_kept").c_str(), clock, kept_node),
          returned((what + "_returned").c_str(), clock, returned_node) {}
    GraphNode kept_node, returned_node;
    GraphThread<std::uint8_t> kept, returned;
  };

  const PipelineCase case_;
  ClockDomain clock_;
  Dataflow dataflow_;
  Pipeline pipeline_;
  GraphNode left_node_, right_node_, map_node_, output_node_;
  GraphThread<std::uint8_t> left_, right_, map_, output_;
  std::unique_ptr<StoreEnds> rows_, frame_;
  std::vector<EdgeDates> dates_;
  std::vector<std::unique_ptr<DateLog>> logs_;
};

}  // namespace parallax::test
