// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <systemc>

#include "platform/machine_input.hpp"
#include "platform/memory_map.hpp"
#include "platform/pipeline.hpp"
#include "tlm/dma.hpp"

namespace parallax {

/// A frame for the core, by where its buffers lie in memory.
struct CoreJob {
  std::uint64_t left = 0;      ///< address of the left image, as the camera wrote it
  std::uint64_t right = 0;     ///< likewise
  bool values = true;          ///< false: timing only
  std::function<void()> read;  ///< called when both images have been read
};

/// The stereo core: the pipeline with the DMA engines of its memory ports left, right, map and output.
class StereoCore final : public sc_core::sc_module {
 public:
  StereoCore(const sc_core::sc_module_name& name, const MachineConfig& config, const MachineInput& input,
             std::uint64_t map_address, const ClockDomain& clock, Dataflow& dataflow);

  /// Queues a frame's input.
  void start(const CoreJob& job);
  /// Queues the place of the next frame's results; `written` is called when they are in memory.
  void start_output(std::uint64_t address, bool values, std::function<void()> written);

  Pipeline& pipeline() { return pipeline_; }
  const Pipeline& pipeline() const { return pipeline_; }
  BusMaster& left_master() { return dma_left_.master; }
  BusMaster& right_master() { return dma_right_.master; }
  BusMaster& map_master() { return dma_map_.master; }
  BusMaster& output_master() { return dma_output_.master; }

 private:
  const MachineInput& input_;
  const std::uint64_t map_address_;
  DmaReader dma_left_;
  DmaReader dma_right_;
  DmaReader dma_map_;
  DmaWriter dma_output_;
  Pipeline pipeline_;
};

}  // namespace parallax
