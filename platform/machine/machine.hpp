// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

#include "platform/config/machine_config.hpp"
#include "platform/machine/acquisition.hpp"
#include "platform/machine/frame_ledger.hpp"
#include "platform/machine/host.hpp"
#include "platform/machine/machine_input.hpp"
#include "platform/machine/machine_snapshot.hpp"
#include "platform/machine/memory_map.hpp"
#include "platform/machine/memory_port.hpp"
#include "platform/machine/part.hpp"
#include "platform/machine/software.hpp"
#include "platform/machine/stereo_core.hpp"
#include "platform/machine/tile_plan.hpp"
#include "platform/machine/transmission.hpp"
#include "platform/machine/watchdog.hpp"
#include "tlm/memory.hpp"

namespace parallax {

/// The whole machine: who is connected to whom. A frame goes from acquisition, through the memory, to
/// software, which starts the stereo core with it, and from the core to software, which has transmission send
/// it to the host; the ledger takes down when. Several frames are in flight: one is read out while another is
/// processed and a third is sent.
///
/// Ports of the memory, in the order of binding: camera_left, camera_right, left, right, map, output, link;
/// then, for a matcher that keeps something in memory, buffer_row_write and buffer_row_read, and
/// buffer_frame_write and buffer_frame_read.
class Machine final : public sc_core::sc_module {
 public:
  Machine(const sc_core::sc_module_name& name, const MachineConfig& config, const MachineInput& input);

  /// Whether the host has all frames; false after a run means that the machine got stuck.
  bool finished() const { return host_.done(); }
  /// That the host has.
  std::int64_t frames() const { return host_.frames(); }

  const MachineConfig& config() const { return config_; }
  const MachineInput& input() const { return input_; }
  /// Of all frames that were exposed, more than `input.frames`; see FrameLedger.
  const KeptRecords<FrameTimes>& times() const { return ledger_.times(); }
  /// What had happened when the host had a frame, one for each frame.
  const KeptRecords<MachineSnapshot>& snapshots() const { return ledger_.snapshots(); }
  /// Of all frames that the host has.
  const FrameLatencies& latencies() const { return ledger_.latencies(); }
  const LatencyTrend& trend() const { return ledger_.trend(); }
  const LossCycles& losses() const { return ledger_.losses(); }
  bool settled() const { return ledger_.settled(); }
  const Pipeline& pipeline() const { return core_.pipeline(); }
  const Dataflow& dataflow() const { return dataflow_; }
  /// None when the run brought another memory along.
  const Memory* memory() const { return memory_.get(); }
  /// The core's registers, for other initiators beside the machine's own software. Bind before the simulation
  /// starts.
  RegisterBank& registers() { return core_.control().bank; }
  /// Starts that the core has refused (an initiator has switched it off, say); software tries again.
  std::int64_t rejected_starts() const { return software_.rejected_starts(); }
  /// In the order of the memory's statistics.
  const std::vector<MemoryPort*>& ports() const { return ports_; }
  /// The port that brings the rectification map.
  const MemoryPort& map_port() const { return core_.map_port(); }
  /// All that can limit the frame rate, in the order in which data meets them: memory, cameras, DMA engines,
  /// software, core, stages, link, host. From the start of the simulation on.
  const std::vector<Part>& parts() const { return parts_; }
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
  Acquisition::Hooks acquisition_hooks();
  StereoCore::Hooks core_hooks();
  void received(std::int64_t frame, const std::vector<std::uint8_t>& bytes);
  void start_of_simulation() override;
  std::vector<MemoryPort*> collect_ports();
  std::vector<Part> collect_parts() const;
  MachineSnapshot snapshot();
  Watchdog::Watched watched();
  void start_watchdog();

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
  FrameLedger ledger_;
  const std::unique_ptr<Memory> memory_;
  Acquisition acquisition_;
  StereoCore core_;
  Transmission transmission_;
  Software software_;
  Host host_;
  const std::vector<MemoryPort*> ports_;
  std::vector<Part> parts_;
  Watchdog watchdog_;
  std::int64_t rejected_starts_ = 0;  // when the watchdog looked last
};

}  // namespace parallax
