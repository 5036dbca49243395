// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

#include "platform/machine/machine_input.hpp"
#include "platform/machine/memory_map.hpp"
#include "platform/machine/memory_port.hpp"
#include "platform/machine/part.hpp"
#include "platform/machine/pipeline.hpp"
#include "platform/registers/algorithm_parameters.hpp"
#include "tlm/dma.hpp"

namespace parallax {

/// A writer that has not finished what the core is to read; see DmaJob::behind.
struct ImageSource {
  std::shared_ptr<TransferProgress> progress;  ///< null: all of the image is in memory
  std::uint64_t bursts_before = 0;             ///< that the writer had written before this image
  Bytes burst{0};                              ///< of the writer

  /// Bursts after which the first `bytes` bytes of the image are there.
  std::uint64_t bursts_until(std::uint64_t bytes) const { return bursts_before + burst_count(bytes, burst); }
};

/// A frame for the core, by where its buffers lie in memory.
struct CoreJob {
  std::uint64_t left = 0;   ///< address of the left image, as the camera wrote it
  std::uint64_t right = 0;  ///< likewise
  std::uint64_t map = 0;    ///< address of the compressed map\'s bytes
  bool values = true;       ///< false: timing only
  AlgorithmParameters parameters{};
  std::uint64_t output = 0;  ///< address of the results
  std::uint64_t buffer = 0;  ///< address of what the matcher keeps in memory (MatcherStore)
  ImageSource left_source{};
  ImageSource right_source{};
  std::function<void()> read;     ///< called when both images have been read
  std::function<void()> written;  ///< called when the results are in memory
  /// Called, if there is one, when link.early_start_rows of the results are there.
  std::function<void()> early{};
};

/// What stays the same from frame to frame.
struct CoreMap {
  const TilePlan& tiles;
  const EncodedMap& map;  ///< cut for the tiles
};

/// The stereo core: the pipeline with the DMA engines of its memory ports left, right, map and output. An
/// image of several tiles is read, and its results are written, tile by tile, each row of a tile by itself.
/// What the matcher keeps in memory has ports of its own: what has been written is read back as soon as it is
/// answered for and there is room.
class StereoCore final : public sc_core::sc_module {
 public:
  StereoCore(const sc_core::sc_module_name& name, const MachineConfig& config, const MachineInput& input,
             const CoreMap& map, const ClockDomain& clock, Dataflow& dataflow);

  /// Queues a frame.
  void start(const CoreJob& job);

  /// For who reads results while they come: told of the bursts of the last tile;
  /// null unless a link sends early (link.early_start_rows).
  const std::shared_ptr<TransferProgress>& output_progress() const { return output_progress_; }
  /// Bursts of the frame, counted so, that hold its first `rows` rows.
  std::uint64_t output_bursts_until(std::uint64_t rows) const;

  Pipeline& pipeline() { return pipeline_; }
  const Pipeline& pipeline() const { return pipeline_; }
  /// left, right, map, output.
  std::vector<MemoryPort>& ports() { return ports_; }
  /// The port that brings the rectification map.
  const MemoryPort& map_port() const { return ports_[2]; }
  /// Those that write and read back what the matcher keeps in memory, as far as it does: buffer_row_write,
  /// buffer_row_read, buffer_frame_write, buffer_frame_read.
  std::vector<MemoryPort>& buffer_ports() { return buffer_ports_; }
  /// Tells the ports which stage is at their other end; when all is bound.
  void find_stages();
  /// Every stage; before them the core as a whole, unless frames queue in it. After find_stages().
  std::vector<Part> parts() const;

 private:
  void make_ports(const DmaConfig& config);
  void start_input(const CoreJob& job);
  void start_output(const CoreJob& job);
  void start_store(const CoreJob& job);
  DmaJob output_job(const Tile& tile) const;

  struct StorePorts {
    StorePorts(const std::string& what, const DmaPortConfig& config, const ClockDomain& clock,
               Dataflow& dataflow);
    DmaWriter write;
    DmaReader read;
    std::shared_ptr<TransferProgress> progress;
    std::uint64_t bursts = 0;  // started
  };

  const MachineInput& input_;
  const CoreMap map_;
  const PixelFormat format_;
  const bool queue_frames_;
  const OutputLeft output_left_;
  DmaReader dma_left_;
  DmaReader dma_right_;
  DmaReader dma_map_;
  DmaWriter dma_output_;
  Pipeline pipeline_;
  const std::uint32_t early_rows_;
  const Bytes output_burst_;
  std::shared_ptr<TransferProgress> output_progress_;
  std::unique_ptr<StorePorts> rows_;   // if the matcher keeps rows
  std::unique_ptr<StorePorts> frame_;  // if it keeps a frame
  std::vector<MemoryPort> ports_;
  std::vector<MemoryPort> buffer_ports_;
};

}  // namespace parallax
