// SPDX-License-Identifier: Apache-2.0
#include "platform/acquisition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "platform/engine_config.hpp"
#include "platform/when_both.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

std::int64_t row_bytes(const MachineConfig& config, const MachineInput& input) {
  return static_cast<std::int64_t>(bytes_of(config.camera.format, static_cast<std::uint64_t>(input.width)));
}

// A row takes its pixels and the blanking at the pixel clock, or as long as the cable needs for it.
SensorConfig sensor_config(const MachineConfig& config, const MachineInput& input) {
  const std::int64_t read_out = std::int64_t{input.width} + config.camera.row_blanking;
  const std::int64_t cable =
      (row_bytes(config, input) * config.clocks.camera_hz + config.camera.bytes_per_second - 1) /
      config.camera.bytes_per_second;
  SensorConfig sensor;
  sensor.width = input.width;
  sensor.height = input.height;
  sensor.row = Cycles(std::max(read_out, cable));
  sensor.frame_blanking = Cycles(config.camera.frame_blanking);
  sensor.format = config.camera.format;
  sensor.burst = Bytes(config.dma.camera.burst_bytes);
  return sensor;
}

}  // namespace

Acquisition::Acquisition(const sc_core::sc_module_name& name, const MachineConfig& config,
                         const MachineInput& input, const MemoryMap& memory_map, const ClockDomain& clock,
                         Dataflow& dataflow, Listener listener)
    : sc_module(name),
      config_(config),
      input_(input),
      memory_map_(memory_map),
      clock_(clock),
      listener_(std::move(listener)),
      left_sensor_("left_sensor", sensor_config(config, input), clock, dataflow),
      right_sensor_("right_sensor", sensor_config(config, input), clock, dataflow),
      dma_left_("dma_left", engine_config(config.dma.camera), clock),
      dma_right_("dma_right", engine_config(config.dma.camera), clock),
      left_bursts_("camera_left_bursts", dataflow, clock, clock, engine_config(config.dma.camera).fifo()),
      right_bursts_("camera_right_bursts", dataflow, clock, clock, engine_config(config.dma.camera).fifo()) {
  left_sensor_.out_bursts(left_bursts_);
  right_sensor_.out_bursts(right_bursts_);
  dma_left_.in_bursts(left_bursts_);
  dma_right_.in_bursts(right_bursts_);
  if (config.camera.frame_rate > 0) {
    trigger_.emplace(config.camera, clock.frequency());
    if (trigger_->period() < left_sensor_.frame_time()) {
      throw UserError(
          fmt::format("camera.frame_rate = {}: reading out {}x{} px takes {} pixel clocks, which allows at "
                      "most {:.2f} frames/s",
                      config.camera.frame_rate, input.width, input.height, left_sensor_.frame_time().count(),
                      1 / clock.seconds(left_sensor_.frame_time())));
    }
  }
  SC_HAS_PROCESS(Acquisition);
  SC_THREAD(expose_frames);
}

const MemoryMap::FrameBuffer& Acquisition::buffer(std::int64_t frame) const {
  return memory_map_.frames[static_cast<std::size_t>(frame) % memory_map_.frames.size()];
}

void Acquisition::release() {
  --buffers_used_;
  buffer_free_.notify();
}

// Nothing that has to be freed lives on this thread's stack while it waits: it never ends.
void Acquisition::expose_frames() {
  if (trigger_) {
    expose_at_rate();
  } else {
    expose_on_demand();
  }
}

void Acquisition::expose_on_demand() {
  for (;;) {
    wait_for_buffer();
    ++counts_.triggers;
    expose(counts_.taken++);
    sc_core::wait(frame_complete_);
    clock_.wait_until(clock_.cycle_at_or_after(exposed_) + left_sensor_.frame_time());
  }
}

// While no buffer is free, nothing happens at the triggers; they are accounted for when one is. So the kernel
// runs out of events when the machine is stuck.
void Acquisition::expose_at_rate() {
  next_ = trigger_->exposed(0);
  for (;;) {
    clock_.wait_until(next_);
    wait_for_buffer();
    drop_passed();
    if (next_ > clock_.now()) continue;
    if (note_trigger()) expose(counts_.taken++);
  }
}

void Acquisition::wait_for_buffer() {
  while (buffers_used_ == static_cast<std::int64_t>(memory_map_.frames.size())) {
    sc_core::wait(buffer_free_);
  }
}

// Triggers before now that have not been taken found no buffer.
void Acquisition::drop_passed() {
  while (next_ < clock_.now()) {
    const Cycles begin = next_;
    if (!note_trigger()) continue;
    ++counts_.dropped;
    left_sensor_.read_out_unheard(begin);
    right_sensor_.read_out_unheard(begin);
  }
}

// Goes on to the trigger after the next one; whether the sensors took that one.
bool Acquisition::note_trigger() {
  const Cycles cycle = next_;
  next_ = trigger_->exposed(++counts_.triggers);
  const bool taken = !left_sensor_.reads_out_in(cycle) && !right_sensor_.reads_out_in(cycle);
  if (!taken) ++counts_.missed;
  return taken;
}

CameraCounts Acquisition::counts() {
  if (trigger_) drop_passed();
  return counts_;
}

void Acquisition::expose(std::int64_t frame) {
  ++buffers_used_;
  const StereoFrame images = frame < input_.frames && input_.expose ? input_.expose(frame) : StereoFrame{};
  const bool values = images.left != nullptr;
  exposed_ = sc_core::sc_time_stamp();
  listener_.exposed(frame, values);
  const std::function<void()> done = when_both([this, frame] {
    frame_complete_.notify();
    listener_.in_memory(frame);
  });
  const std::vector<std::uint32_t> rows(static_cast<std::size_t>(input_.height),
                                        static_cast<std::uint32_t>(row_bytes(config_, input_)));
  const std::function<void()> begun = [this, frame] { listener_.begun(frame); };
  dma_left_.start({buffer(frame).left, rows, values, done, 0, begun});
  dma_right_.start({buffer(frame).right, rows, values, done, 0, begun});
  left_sensor_.read_out(images.left);
  right_sensor_.read_out(images.right);
}

}  // namespace parallax
