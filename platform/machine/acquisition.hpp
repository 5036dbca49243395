// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <systemc>
#include <vector>

#include "platform/config/machine_config.hpp"
#include "platform/machine/camera_trigger.hpp"
#include "platform/machine/frame.hpp"
#include "platform/machine/frame_writer.hpp"
#include "platform/machine/machine_input.hpp"
#include "platform/machine/machine_snapshot.hpp"
#include "platform/machine/memory_map.hpp"
#include "platform/machine/memory_port.hpp"
#include "platform/machine/part.hpp"
#include "platform/machine/sensor.hpp"
#include "tlm/dma.hpp"

namespace parallax {

/// The cameras' side of the machine: two sensors, the DMA engines that write their images, and the frame
/// buffers in memory. Without a rate of their own the cameras are triggered when a buffer is free. With one
/// they cannot wait: a frame that finds no buffer when its read-out begins is dropped whole, and a trigger
/// that finds a sensor reading out is missed. A buffer that becomes free at that very date is free.
///
/// A frame with a fault (MachineConfig::camera) fills a buffer as far as it gets; when both images have ended
/// it is found out, and the buffer is free again. It has no number.
class Acquisition final : public sc_core::sc_module {
 public:
  /// Told of each frame, in order.
  struct Hooks {
    /// `due`: when it would have been exposed without jitter; `lost`: triggers before it that found no buffer
    /// or a sensor reading out; `values`: it carries images.
    std::function<void(std::int64_t frame, const sc_core::sc_time& due, std::int64_t lost, bool values)>
        exposed;
    std::function<void(std::int64_t frame)> begun;  ///< the first bytes of an image are in memory
    std::function<void(std::int64_t frame)>
        startable;  ///< as much of both images as the core waits for is there
    std::function<void(std::int64_t frame)> in_memory;  ///< both images are there
    std::function<void(CameraFault fault)> faulty;      ///< a frame was found to have a fault
  };

  Acquisition(const sc_core::sc_module_name& name, const MachineConfig& config, const MachineInput& input,
              const MemoryMap& memory_map, const ClockDomain& clock, Dataflow& dataflow, Hooks hooks);

  /// The oldest frame has been read: its buffer is free.
  void release();

  /// The engines, for a core that reads a frame while it comes (camera.early_start_rows).
  FrameWriter left_writer() const { return writer(left_progress_); }
  FrameWriter right_writer() const { return writer(right_progress_); }

  /// camera_left, camera_right.
  std::vector<MemoryPort>& ports() { return ports_; }
  /// The cameras, and the rate that they are set to, if any.
  std::vector<Part> parts() const;
  const Sensor& sensor() const { return left_sensor_; }
  /// Until now.
  CameraCounts counts();
  /// Whether a frame will be exposed at a later date, whatever happens until then.
  bool frame_due() const {
    return next_ > clock_.now() && buffers_used_ < static_cast<std::int64_t>(memory_map_.frames.size());
  }

 private:
  void expose_frames();
  void expose_on_demand();
  void expose_at_rate();
  void wait_for_buffer();
  void drop_passed();
  bool note_trigger();
  Cycles next_on_demand() const;
  bool next_is_faulty();
  sc_core::sc_time due() const;
  CameraFault found_fault(const Received& left, const Received& right) const;
  void expose_next();
  void expose(std::int64_t frame);
  void expose_faulty();
  FrameWriter writer(const std::shared_ptr<TransferProgress>& progress) const;
  DmaJob image_job(std::uint64_t address, bool values, int rows) const;

  const MachineConfig& config_;
  const MachineInput& input_;
  const MemoryMap& memory_map_;
  const ClockDomain& clock_;
  const Hooks hooks_;
  Sensor left_sensor_;
  Sensor right_sensor_;
  const Cycles exposure_;
  const Cycles skew_;
  DmaWriter dma_left_;
  DmaWriter dma_right_;
  std::shared_ptr<TransferProgress> left_progress_;
  std::shared_ptr<TransferProgress> right_progress_;
  Stream<std::uint8_t> left_bursts_;
  Stream<std::uint8_t> right_bursts_;
  std::vector<MemoryPort> ports_;

  sc_core::sc_event frame_complete_;  // both images are in memory
  std::int64_t buffers_used_ = 0;     // frames from exposure until both images are read
  sc_core::sc_event buffer_free_;
  sc_core::sc_time buffer_free_since_;  // since when a buffer has been free; of no meaning while none is
  std::uint32_t until_fault_;           // frames, this one included
  sc_core::sc_time exposed_;            // date of the last exposure
  CameraCounts counts_;
  std::optional<CameraTrigger> trigger_;  // of cameras with a rate
  Cycles next_{0};                        // end of the next exposure, once it is known
};

}  // namespace parallax
