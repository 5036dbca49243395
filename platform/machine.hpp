// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <set>
#include <systemc>
#include <vector>

#include "platform/config/machine_config.hpp"
#include "platform/ethernet_link.hpp"
#include "platform/frame.hpp"
#include "platform/memory_map.hpp"
#include "platform/pipeline.hpp"
#include "tlm/memory.hpp"

namespace parallax {

/// What a run of the machine is made of, apart from its configuration.
struct MachineInput {
  int width = 0;   ///< px, of the images as they are processed
  int height = 0;  ///< px
  const EncodedMap* map = nullptr;
  std::int64_t frames = 1;
  bool timing_only = false;  ///< no frame has images, so the memory need not hold any
  /// Called, if there is one, once a frame, in order, when it is exposed. The cameras go on after the last
  /// one, without images, until the host has all frames, so that every frame meets the traffic of its
  /// successors.
  std::function<StereoFrame(std::int64_t frame)> expose;
  /// Called, if there is one, once a frame, in order, when the host has it.
  std::function<void(const FrameResult& result)> deliver;
};

/// The whole machine: two sensors, the memory with its ports, the pipeline, the link, and what hands frames
/// from one to the next. Several frames are in flight: one is read out while another is processed and a third
/// is sent.
///
/// Ports of the memory, in the order of binding: camera_left, camera_right, left, right, map, output, link.
class Machine final : public sc_core::sc_module {
 public:
  Machine(const sc_core::sc_module_name& name, const MachineConfig& config, const MachineInput& input);

  /// Whether the host has all frames; false after a run means that the machine got stuck.
  bool finished() const { return delivered_ == input_.frames; }

  const MachineConfig& config() const { return config_; }
  const MachineInput& input() const { return input_; }
  /// Of all frames that were exposed, more than `input.frames`; those after it may be unfinished.
  const std::vector<FrameTimes>& times() const { return times_; }
  /// What had happened when the host had a frame, an entry for each frame delivered.
  const std::vector<Activity>& activities() const { return activities_; }
  /// Requests that the DMA engine of each memory port can have under way.
  std::vector<std::uint32_t> dma_places() const;
  const Pipeline& pipeline() const { return pipeline_; }
  const Dataflow& dataflow() const { return dataflow_; }
  const Memory& memory() const { return memory_; }
  const MemoryMap& memory_map() const { return memory_map_; }
  const EthernetLink& link() const { return link_; }
  const Sensor& sensor() const { return left_sensor_; }
  const ClockDomain& core_clock() const { return core_clock_; }
  const ClockDomain& camera_clock() const { return camera_clock_; }
  const ClockDomain& link_clock() const { return link_clock_; }
  /// Names of the memory's ports, in the order of its statistics.
  static const std::vector<const char*>& port_names();

 private:
  void expose_frames();
  void frame_in_memory(std::int64_t frame);
  void start_outputs();
  void results_in_memory(std::int64_t frame);
  void take_row(const Disparity* row);
  void deliver(std::int64_t frame, const std::vector<std::uint8_t>& bytes);
  void wait_for_input_buffer();
  void expose(std::int64_t frame);
  void place_map();
  std::vector<BusMaster*> masters();  // in the order of the memory's ports
  Activity activity();

  const MachineConfig config_;
  const MachineInput input_;
  const MemoryMap memory_map_;
  ClockDomain core_clock_;
  ClockDomain memory_clock_;
  ClockDomain camera_clock_;
  ClockDomain link_clock_;
  Dataflow dataflow_;
  Memory memory_;
  Sensor left_sensor_;
  Sensor right_sensor_;
  DmaWriter dma_camera_left_;
  DmaWriter dma_camera_right_;
  DmaReader dma_left_;
  DmaReader dma_right_;
  DmaReader dma_map_;
  DmaWriter dma_output_;
  DmaReader dma_link_;
  Pipeline pipeline_;
  EthernetLink link_;
  Stream<std::uint8_t> camera_left_bursts_;
  Stream<std::uint8_t> camera_right_bursts_;
  Stream<std::uint8_t> link_bursts_;

  std::vector<FrameTimes> times_;
  std::vector<Activity> activities_;
  sc_core::sc_event frame_complete_;     // both images are in memory
  std::vector<bool> values_;             // whether a frame carries images
  std::int64_t input_buffers_used_ = 0;  // frames from exposure until both images are read
  sc_core::sc_event input_buffer_free_;
  bool waits_for_buffer_ = false;
  sc_core::sc_time buffer_wait_;        // of the waits that are over
  sc_core::sc_time buffer_wait_began_;  // of the one under way
  std::int64_t to_output_ = 0;          // next frame that gets an output buffer
  std::int64_t processing_ = 0;         // frames handed to the pipeline
  std::int64_t output_buffers_used_ = 0;
  std::int64_t delivered_ = 0;
  std::deque<std::vector<Disparity>> labelled_;  // frames on their way to the host, as the pipeline made them
  std::vector<Disparity> labelled_rows_;         // of the frame that is leaving the pipeline
};

}  // namespace parallax
