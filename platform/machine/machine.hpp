// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

#include "platform/config/machine_config.hpp"
#include "platform/machine/acquisition.hpp"
#include "platform/machine/frame.hpp"
#include "platform/machine/frame_latencies.hpp"
#include "platform/machine/machine_input.hpp"
#include "platform/machine/machine_snapshot.hpp"
#include "platform/machine/memory_map.hpp"
#include "platform/machine/memory_port.hpp"
#include "platform/machine/part.hpp"
#include "platform/machine/stereo_core.hpp"
#include "platform/machine/tile_plan.hpp"
#include "platform/machine/transmission.hpp"
#include "platform/registers/control_blocks.hpp"
#include "platform/registers/core_driver.hpp"
#include "tlm/kept_records.hpp"
#include "tlm/memory.hpp"

namespace parallax {

/// The whole machine: acquisition, memory, stereo core, transmission, and what hands frames from one to the
/// next. Several frames are in flight: one is read out while another is processed and a third
/// is sent.
///
/// Ports of the memory, in the order of binding: camera_left, camera_right, left, right, map, output, link;
/// then, for a matcher that keeps something in memory, buffer_row_write and buffer_row_read, and
/// buffer_frame_write and buffer_frame_read.
class Machine final : public sc_core::sc_module {
 public:
  Machine(const sc_core::sc_module_name& name, const MachineConfig& config, const MachineInput& input);

  /// Whether the host has all frames; false after a run means that the machine got stuck.
  bool finished() const { return delivered_ == input_.frames; }

  const MachineConfig& config() const { return config_; }
  const MachineInput& input() const { return input_; }
  /// Of all frames that were exposed, more than `input.frames`; those after it may be unfinished. Of long
  /// runs the first and the last frames only, at least 160 beyond the warm-up.
  const KeptRecords<FrameTimes>& times() const { return times_; }
  /// What had happened when the host had a frame, an entry for each frame delivered; kept likewise.
  const KeptRecords<MachineSnapshot>& snapshots() const { return snapshots_; }
  /// Of all frames delivered.
  const FrameLatencies& latencies() const { return latencies_; }
  const Pipeline& pipeline() const { return core_.pipeline(); }
  const Dataflow& dataflow() const { return dataflow_; }
  /// None when the run brought another memory along.
  const Memory* memory() const { return memory_.get(); }
  /// The core's registers, for other initiators beside the machine's own software. Bind before the simulation
  /// starts.
  RegisterBank& registers() { return control_.bank; }
  /// Starts that the core has refused (an initiator has switched it off, say); software tries again.
  std::int64_t rejected_starts() const { return rejected_starts_; }
  /// In the order of the memory's statistics.
  const std::vector<MemoryPort*>& ports() const { return ports_; }
  /// The port that brings the rectification map.
  const MemoryPort& map_port() const { return core_.map_port(); }
  /// All that can limit the frame rate, in the order in which data meets them: memory, cameras, DMA engines,
  /// software, core, stages, link, host. From the start of the simulation on.
  const std::vector<Part>& parts() const { return parts_; }
  /// By the name in results; null if there is none of that name.
  const Part* find_part(const std::string& name) const;
  const TilePlan& tiles() const { return tiles_; }
  /// The rectification map as it lies in memory: cut for the tiles.
  const EncodedMap& map() const { return tiles_.tiles.size() > 1 ? tiled_map_ : *input_.map; }
  const MemoryMap& memory_map() const { return memory_map_; }
  const EthernetLink& link() const { return transmission_.link(); }
  const Sensor& sensor() const { return acquisition_.sensor(); }
  const ClockDomain& core_clock() const { return core_clock_; }
  const ClockDomain& camera_clock() const { return camera_clock_; }
  const ClockDomain& link_clock() const { return link_clock_; }

 private:
  void tell(std::int64_t frame, FrameStep step);
  void frame_in_memory(std::int64_t frame);
  void start_when_possible();
  void start_core();
  void core_started(const FrameCommand& command);
  CoreFacts core_facts();
  void results_in_memory(std::int64_t frame);
  void send_results(std::int64_t frame);
  ImageSource image_source(const std::shared_ptr<TransferProgress>& progress, std::int64_t frame) const;
  void take_row(const Disparity* row);
  void deliver(std::int64_t frame, const std::vector<std::uint8_t>& bytes);
  std::uint64_t output_buffer(std::int64_t frame) const;
  void start_of_simulation() override;
  std::vector<MemoryPort*> collect_ports();
  std::vector<Part> collect_parts() const;
  MachineSnapshot snapshot();
  sc_core::sc_time core_taken() const;
  void note_output_full(bool full);

  const MachineConfig config_;
  const MachineInput input_;
  const TilePlan tiles_;
  const EncodedMap tiled_map_;  // unless there is one tile
  const MemoryMap memory_map_;
  ClockDomain core_clock_;
  ClockDomain memory_clock_;
  ClockDomain camera_clock_;
  ClockDomain link_clock_;
  Dataflow dataflow_;
  const std::unique_ptr<Memory> memory_;
  Acquisition acquisition_;
  StereoCore core_;
  Transmission transmission_;
  const std::vector<MemoryPort*> ports_;
  const CoreFacts facts_;
  ControlBlocks control_;
  CoreDriver driver_;

  std::vector<Part> parts_;
  KeptRecords<FrameTimes> times_;
  KeptRecords<MachineSnapshot> snapshots_;
  FrameLatencies latencies_;
  std::vector<bool> values_;         // whether a frame carries images
  std::int64_t in_memory_ = 0;       // frames
  std::int64_t started_ = 0;         // of them, in the core or through it
  bool starting_ = false;            // software is about to start the next one,
  sc_core::sc_time starting_since_;  // from this date on
  sc_core::sc_time starting_time_;   // spent with that before
  bool offering_ = false;            // it writes the registers of one: no other start is expected
  bool parameters_written_ = false;  // once, before the first frame
  std::int64_t rejected_starts_ = 0;
  std::int64_t in_core_ = 0;            // frames
  sc_core::sc_time core_taken_;         // time in which the core worked or was about to be started, until
  sc_core::sc_time core_taken_since_;   // this date
  bool output_full_ = false;            // only a buffer for its results keeps the core from a frame
  sc_core::sc_time output_full_time_;   // in which that was so, until
  sc_core::sc_time output_full_since_;  // this date
  sc_core::sc_event start_;
  std::int64_t output_buffers_used_ = 0;
  std::int64_t delivered_ = 0;
  std::deque<std::vector<Disparity>> labelled_;  // frames on their way to the host, as the pipeline made them
  std::vector<Disparity> labelled_rows_;         // of the frame that is leaving the pipeline
  std::size_t rows_taken_ = 0;                   // of all its tiles
};

}  // namespace parallax
