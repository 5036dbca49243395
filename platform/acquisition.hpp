// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <systemc>

#include "platform/config/machine_config.hpp"
#include "platform/machine_input.hpp"
#include "platform/memory_map.hpp"
#include "platform/sensor.hpp"
#include "tlm/dma.hpp"

namespace parallax {

/// The cameras' side of the machine: two sensors, the DMA engines that write their images, and the frame
/// buffers in memory. A frame is exposed whenever a buffer is free and its time has come.
class Acquisition final : public sc_core::sc_module {
 public:
  /// Told of each frame, in order.
  struct Listener {
    std::function<void(std::int64_t frame, bool values)> exposed;  ///< `values`: it carries images
    std::function<void(std::int64_t frame)> in_memory;             ///< both images are complete
  };

  Acquisition(const sc_core::sc_module_name& name, const MachineConfig& config, const MachineInput& input,
              const MemoryMap& memory_map, const ClockDomain& clock, Dataflow& dataflow, Listener listener);

  /// The buffer that a frame lies in.
  const MemoryMap::FrameBuffer& buffer(std::int64_t frame) const;
  /// The oldest frame has been read: its buffer is free.
  void release();

  BusMaster& left_master() { return dma_left_.master; }
  BusMaster& right_master() { return dma_right_.master; }
  const Sensor& sensor() const { return left_sensor_; }
  /// Time in which the cameras waited for a frame buffer, until now.
  sc_core::sc_time buffer_wait() const;

 private:
  void expose_frames();
  void wait_for_buffer();
  void expose(std::int64_t frame);

  const MachineConfig& config_;
  const MachineInput& input_;
  const MemoryMap& memory_map_;
  const ClockDomain& clock_;
  const Listener listener_;
  Sensor left_sensor_;
  Sensor right_sensor_;
  DmaWriter dma_left_;
  DmaWriter dma_right_;
  Stream<std::uint8_t> left_bursts_;
  Stream<std::uint8_t> right_bursts_;

  sc_core::sc_event frame_complete_;  // both images are in memory
  std::int64_t buffers_used_ = 0;     // frames from exposure until both images are read
  sc_core::sc_event buffer_free_;
  sc_core::sc_time exposed_;  // date of the last exposure
  bool waits_for_buffer_ = false;
  sc_core::sc_time buffer_wait_;        // of the waits that are over
  sc_core::sc_time buffer_wait_began_;  // of the one under way
};

}  // namespace parallax
