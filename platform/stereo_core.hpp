// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <systemc>

#include "platform/algorithm_parameters.hpp"
#include "platform/machine_input.hpp"
#include "platform/memory_map.hpp"
#include "platform/pipeline.hpp"
#include "tlm/dma.hpp"

namespace parallax {

/// A frame for the core, by where its buffers lie in memory.
struct CoreJob {
  std::uint64_t left = 0;   ///< address of the left image, as the camera wrote it
  std::uint64_t right = 0;  ///< likewise
  std::uint64_t map = 0;    ///< address of the compressed map\'s bytes
  bool values = true;       ///< false: timing only
  AlgorithmParameters parameters{};
  std::uint64_t output = 0;       ///< address of the results
  std::function<void()> read;     ///< called when both images have been read
  std::function<void()> written;  ///< called when the results are in memory
};

/// What stays the same from frame to frame.
struct CoreMap {
  const TilePlan& tiles;
  const EncodedMap& map;  ///< cut for the tiles
};

/// The stereo core: the pipeline with the DMA engines of its memory ports left, right, map and output. An
/// image of several tiles is read, and its results are written, tile by tile, each row of a tile by itself.
class StereoCore final : public sc_core::sc_module {
 public:
  StereoCore(const sc_core::sc_module_name& name, const MachineConfig& config, const MachineInput& input,
             const CoreMap& map, const ClockDomain& clock, Dataflow& dataflow);

  /// Queues a frame.
  void start(const CoreJob& job);

  Pipeline& pipeline() { return pipeline_; }
  const Pipeline& pipeline() const { return pipeline_; }
  BusMaster& left_master() { return dma_left_.master; }
  BusMaster& right_master() { return dma_right_.master; }
  BusMaster& map_master() { return dma_map_.master; }
  BusMaster& output_master() { return dma_output_.master; }

 private:
  void start_input(const CoreJob& job);
  void start_output(const CoreJob& job);

  const MachineInput& input_;
  const CoreMap map_;
  const PixelFormat format_;
  const OutputLeft output_left_;
  DmaReader dma_left_;
  DmaReader dma_right_;
  DmaReader dma_map_;
  DmaWriter dma_output_;
  Pipeline pipeline_;
};

}  // namespace parallax
