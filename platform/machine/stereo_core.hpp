// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

#include "platform/machine/frame_writer.hpp"
#include "platform/machine/machine_input.hpp"
#include "platform/machine/memory_map.hpp"
#include "platform/machine/memory_port.hpp"
#include "platform/machine/part.hpp"
#include "platform/machine/pipeline.hpp"
#include "platform/registers/control_blocks.hpp"
#include "tlm/dma.hpp"

namespace parallax {

/// What the core works on, beside the frames' addresses, which its registers hold.
struct CoreInput {
  const TilePlan& tiles;
  const EncodedMap& map;  ///< cut for the tiles
  FrameWriter left;       ///< brings the left images into memory
  FrameWriter right;
};

/// When a frame's first and last disparity left the last filter.
struct CoreDates {
  sc_core::sc_time first_disparity;
  sc_core::sc_time last_disparity;
};

/// The stereo core: the pipeline with the DMA engines of its memory ports left, right, map and output, and
/// the control blocks, whose registers start it. Frames are numbered from 0 in the order of their starts. An
/// image of several tiles is read, and its results are written, tile by tile, each row of a tile by itself.
/// What the matcher keeps in memory has ports of its own: what has been written is read back as soon as it is
/// answered for and there is room.
class StereoCore final : public sc_core::sc_module {
 public:
  struct Hooks {
    /// Whether software is about to start a frame just now; asked at a start, which is refused otherwise.
    std::function<bool()> expected;
    /// Whether a frame carries images; else its time alone passes.
    std::function<bool(std::int64_t frame)> has_values;
    /// A frame is started, within the write to the control register.
    std::function<void(std::int64_t frame)> started;
    /// Both images of the oldest frame that was not read have been read.
    std::function<void()> read;
    /// link.early_start_rows of the results are in memory; called if a link sends early.
    std::function<void(std::int64_t frame)> begun;
    /// All results are in memory, and the status register says so.
    std::function<void(std::int64_t frame, const CoreDates& dates)> written;
  };

  /// `config` and what `input` refers to must outlive the object.
  StereoCore(const sc_core::sc_module_name& name, const MachineConfig& config, const MachineInput& run,
             CoreInput input, Hooks hooks, const ClockDomain& clock, Dataflow& dataflow);

  ControlBlocks& control() { return *control_; }
  /// What its registers take for granted.
  const CoreFacts& facts() const { return facts_; }

  /// The engine that writes results, for who reads them while they come: of several tiles the last one's
  /// bursts count. Without progress unless a link sends early (link.early_start_rows).
  FrameWriter output_writer() const;

  Pipeline& pipeline() { return pipeline_; }
  const Pipeline& pipeline() const { return pipeline_; }
  /// left, right, map, output.
  std::vector<MemoryPort*> ports() { return {&left_port_, &right_port_, &map_port_, &output_port_}; }
  /// The port that brings the rectification map.
  const MemoryPort& map_port() const { return map_port_; }
  /// Those that write and read back what the matcher keeps in memory, as far as it does: buffer_row_write,
  /// buffer_row_read, buffer_frame_write, buffer_frame_read.
  std::vector<MemoryPort*> store_ports() const;
  /// Tells the ports which stage is at their other end; when all is bound.
  void find_stages();
  /// Every stage; before them the core as a whole, unless frames queue in it. After find_stages().
  std::vector<Part> parts() const;

 private:
  void describe_ports();
  CoreFacts make_facts(const MachineConfig& config) const;
  void start(const FrameCommand& command);
  void start_input(std::int64_t frame, const FrameCommand& command);
  void start_output(std::int64_t frame, const FrameCommand& command);
  void start_store(std::int64_t frame, const FrameCommand& command);
  void written(std::int64_t frame);
  DmaJob output_job(const Tile& tile) const;

  struct StoreEngines {  // of what the matcher keeps in memory
    StoreEngines(const std::string& what, const DmaPortConfig& config, const ClockDomain& clock,
                 Dataflow& dataflow);
    DmaWriter write;
    DmaReader read;
    std::shared_ptr<TransferProgress> progress;
    MemoryPort write_port;
    MemoryPort read_port;
    std::uint64_t bursts = 0;  // started
  };

  const MachineInput& run_;
  const CoreInput input_;
  const Hooks hooks_;
  const ClockDomain& clock_;
  const PixelFormat format_;
  const bool queue_frames_;
  const bool software_waits_;  // between a frame that could be started and the start
  const OutputLeft output_left_;
  DmaReader dma_left_;
  DmaReader dma_right_;
  DmaReader dma_map_;
  DmaWriter dma_output_;
  Pipeline pipeline_;
  const std::uint32_t early_rows_;
  const Bytes output_burst_;
  std::shared_ptr<TransferProgress> output_progress_;
  std::unique_ptr<StoreEngines> rows_;   // if the matcher keeps rows
  std::unique_ptr<StoreEngines> frame_;  // if it keeps a frame
  MemoryPort left_port_;
  MemoryPort right_port_;
  MemoryPort map_port_;
  MemoryPort output_port_;
  CoreFacts facts_;
  std::unique_ptr<ControlBlocks> control_;
  std::int64_t started_ = 0;  // frames
};

}  // namespace parallax
