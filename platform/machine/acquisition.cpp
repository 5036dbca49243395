// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/acquisition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "platform/machine/engine_config.hpp"
#include "platform/machine/when_both.hpp"
#include "tlm/error.hpp"
#include "tlm/time_resolution.hpp"
#include "traces/number_text.hpp"

namespace parallax {
namespace {

std::int64_t row_bytes(const MachineConfig& config, const MachineInput& input) {
  return bytes_of(config.camera.format, input.width);
}

// A row takes its pixels and the blanking at the pixel clock, or as long as the cable needs for it.
SensorConfig sensor_config(const MachineConfig& config, const MachineInput& input) {
  const std::int64_t read_out = std::int64_t{input.width} + config.camera.row_blanking;
  const Ratio byte_time(config.clocks.camera_hz, config.camera.bytes_per_second);
  const auto cable = static_cast<std::int64_t>(byte_time.ceil(row_bytes(config, input)));
  SensorConfig sensor;
  sensor.byte_time = byte_time;
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
                         Dataflow& dataflow, Hooks hooks)
    : sc_module(name),
      config_(config),
      input_(input),
      memory_map_(memory_map),
      clock_(clock),
      hooks_(std::move(hooks)),
      left_sensor_("left_sensor", sensor_config(config, input), clock, dataflow),
      right_sensor_("right_sensor", sensor_config(config, input), clock, dataflow),
      exposure_(clock.cycle_at_or_after(nanoseconds(config.camera.exposure_ns))),
      skew_(clock.cycle_at_or_after(nanoseconds(config.camera.skew_ns))),
      dma_left_("dma_left", engine_config(config.dma.camera), clock),
      dma_right_("dma_right", engine_config(config.dma.camera), clock),
      left_bursts_("camera_left_bursts", dataflow, clock, clock, engine_config(config.dma.camera).fifo()),
      right_bursts_("camera_right_bursts", dataflow, clock, clock, engine_config(config.dma.camera).fifo()),
      ports_{{"camera_left", "camera", dma_left_, config.dma.camera},
             {"camera_right", "camera", dma_right_, config.dma.camera}},
      until_fault_(config.camera.fault_every) {
  ports_[0].buffer = BufferKind::kLeft;
  ports_[1].buffer = BufferKind::kRight;
  const std::uint64_t bytes = row_bytes(config, input);
  for (MemoryPort& port : ports_) {
    port.rows = std::make_shared<const RowEnds>(equal_rows(bytes, input.height, 1));
  }
  if (config.camera.early_start_rows > 0) {
    left_progress_ = std::make_shared<TransferProgress>(dataflow);
    right_progress_ = std::make_shared<TransferProgress>(dataflow);
  }
  left_sensor_.out_bursts(left_bursts_);
  right_sensor_.out_bursts(right_bursts_);
  dma_left_.in_bursts(left_bursts_);
  dma_right_.in_bursts(right_bursts_);
  if (config.camera.frame_rate > 0) {
    trigger_.emplace(config.camera, clock.frequency());
    const Cycles read_out = left_sensor_.frame_time();
    const Cycles least = config.camera.overlap ? std::max(exposure_, read_out) : exposure_ + read_out;
    if (trigger_->period() < least) {
      const std::string exposing =
          exposure_ == Cycles(0) ? ""
                                 : fmt::format(", with {} ns of exposure {} it {}", config.camera.exposure_ns,
                                               config.camera.overlap ? "beside" : "before", least.count());
      throw UserError(
          fmt::format("camera.frame_rate = {}: reading out {}x{} px takes {} pixel clocks{}, which allows at "
                      "most {} frames/s",
                      config.camera.frame_rate, input.width, input.height, read_out.count(), exposing,
                      number_text(1 / clock.seconds(least), "frames/s")));
    }
  }
  SC_HAS_PROCESS(Acquisition);
  SC_THREAD(expose_frames);
}

std::vector<Part> Acquisition::parts() const {
  const CameraConfig& config = config_.camera;
  Part cameras{PartKind::kCamera, "camera", "clocks.camera_hz", {Relief::kCamera, Relief::kCameraClock}};
  if (config.exposure_ns > 0) cameras.key = "camera.exposure_ns, clocks.camera_hz";
  if (config.frame_rate == 0 && config.skew_ns > 0) cameras.key += ", camera.skew_ns";
  cameras.core_waits = config.early_start_rows > 0;
  std::vector<Part> parts{cameras};
  if (config.frame_rate > 0) {
    parts.push_back({PartKind::kCameraRate, "camera_frame_rate", "camera.frame_rate", {Relief::kCamera}});
  }
  return parts;
}

void Acquisition::release() {
  if (buffers_used_-- == static_cast<std::int64_t>(memory_map_.frames.size())) {
    buffer_free_since_ = sc_core::sc_time_stamp();
  }
  buffer_free_.notify();
}

FrameWriter Acquisition::writer(const std::shared_ptr<TransferProgress>& progress) const {
  return {progress, static_cast<std::uint64_t>(input_.height),
          [row = static_cast<std::uint64_t>(row_bytes(config_, input_)),
           burst = Bytes(config_.dma.camera.burst_bytes)](std::uint64_t rows) {
            return burst_count(rows * row, burst);
          }};
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
    next_ = next_on_demand();
    clock_.wait_until(next_);
    ++counts_.triggers;
    expose_next();
    sc_core::wait(frame_complete_);
    clock_.wait_until(clock_.cycle_at_or_after(exposed_) + left_sensor_.frame_time());
  }
}

// End of an exposure that begins as soon as there is a buffer for it and the sensors have ended the one
// before, or its read-out.
Cycles Acquisition::next_on_demand() const {
  Cycles begin = clock_.cycle_at_or_after(buffer_free_since_);
  if (counts_.triggers > 0) {
    const Cycles last = clock_.cycle_at_or_after(exposed_);
    begin = std::max(begin, config_.camera.overlap ? last : last + left_sensor_.frame_time());
  }
  return std::max(clock_.now(), begin + exposure_);
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
    if (note_trigger()) expose_next();
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
    right_sensor_.read_out_unheard(begin + skew_);
  }
}

// Goes on to the trigger after the next one; whether the sensors took that one.
bool Acquisition::note_trigger() {
  const Cycles cycle = next_;
  next_ = trigger_->exposed(++counts_.triggers);
  // An exposure that may not overlap the read-out finds the sensors busy when it begins.
  // That of the first one may begin before the model's time does.
  const Cycles begin = config_.camera.overlap ? cycle : std::max(Cycles(0), cycle - exposure_);
  const bool right_free =
      skew_ == Cycles(0) ? !right_sensor_.reads_out_in(begin) : right_sensor_.free_by(begin + skew_);
  const bool taken = !left_sensor_.reads_out_in(begin) && right_free;
  if (!taken) ++counts_.missed;
  return taken;
}

CameraCounts Acquisition::counts() {
  if (trigger_) drop_passed();
  return counts_;
}

bool Acquisition::next_is_faulty() {
  if (config_.camera.fault == CameraFault::kNone || --until_fault_ > 0) return false;
  until_fault_ = config_.camera.fault_every;
  return true;
}

void Acquisition::expose_next() {
  ++buffers_used_;
  exposed_ = sc_core::sc_time_stamp();
  if (next_is_faulty()) {
    expose_faulty();
  } else {
    expose(counts_.taken++);
  }
}

// When the frame that is exposed now would have been without jitter: of the last trigger that was counted.
sc_core::sc_time Acquisition::due() const {
  return trigger_ ? clock_.time_of(trigger_->due(counts_.triggers - 1)) : exposed_;
}

DmaJob Acquisition::image_job(std::uint64_t address, bool values, int rows) const {
  DmaJob job;
  job.address = address;
  job.row_bytes.assign(rows, static_cast<std::uint32_t>(row_bytes(config_, input_)));
  job.values = values;
  return job;
}

void Acquisition::expose(std::int64_t frame) {
  const StereoFrame images = frame < input_.frames && input_.expose ? input_.expose(frame) : StereoFrame{};
  hooks_.exposed(frame, due(), counts_.lost(), images.left != nullptr);
  const std::function<void()> done = when_both([this, frame] {
    hooks_.in_memory(frame);
    frame_complete_.notify();
  });
  const std::function<void()> enough = when_both([this, frame] { hooks_.startable(frame); });
  const std::uint64_t early = config_.camera.early_start_rows;
  const std::uint64_t height = input_.height;
  const std::uint64_t waited_for = (early == 0 ? height : std::min(early, height)) *
                                   static_cast<std::uint64_t>(row_bytes(config_, input_));
  const auto start = [&](DmaWriter& dma, std::uint64_t address,
                         const std::shared_ptr<TransferProgress>& progress) {
    DmaJob job = image_job(address, images.left != nullptr, input_.height);
    job.marks = {{1, [this, frame] { hooks_.begun(frame); }}, {waited_for, enough}};
    job.done = done;
    job.progress = progress;
    dma.start(std::move(job));
  };
  start(dma_left_, memory_map_.images(frame).left, left_progress_);
  start(dma_right_, memory_map_.images(frame).right, right_progress_);
  left_sensor_.read_out(images.left);
  right_sensor_.read_out(images.right, skew_);
}

// What two images show: how far apart they began, and rows that did not come; when the last byte came early,
// the frame was short.
CameraFault Acquisition::found_fault(const Received& left, const Received& right) const {
  const Cycles limit = clock_.cycle_at_or_after(nanoseconds(config_.camera.skew_limit_ns));
  if (std::max(left.begin, right.begin) - std::min(left.begin, right.begin) > limit) {
    return CameraFault::kOutOfStep;
  }
  for (const Received& image : {left, right}) {
    if (image.rows == input_.height) continue;
    const Cycles last_row = left_sensor_.row_time() * (input_.height - 1);
    return image.last_byte <= image.begin + last_row ? CameraFault::kShortFrame : CameraFault::kMissingRow;
  }
  return CameraFault::kNone;
}

// Into the buffer that the next good frame will lie in.
void Acquisition::expose_faulty() {
  const CameraFault fault = config_.camera.fault;
  LostRows lost;
  if (fault != CameraFault::kOutOfStep) {
    lost.count = std::min(static_cast<int>(config_.camera.fault_rows), input_.height - 1);
    lost.first =
        fault == CameraFault::kShortFrame ? input_.height - lost.count : (input_.height - lost.count) / 2;
  }
  const auto left = std::make_shared<Received>();
  const auto right = std::make_shared<Received>();
  const std::function<void()> done = when_both([this, left, right] {
    ++counts_.faulty;
    hooks_.faulty(found_fault(*left, *right));
    release();
    frame_complete_.notify();
  });
  const MemoryMap::FrameBuffer& images = memory_map_.images(counts_.taken);
  DmaJob job = image_job(images.left, false, input_.height - lost.count);
  job.done = done;
  dma_left_.start(job);
  job = image_job(images.right, false, input_.height);
  job.done = done;
  dma_right_.start(job);
  const Cycles late =
      fault == CameraFault::kOutOfStep
          ? clock_.cycle_at_or_after(nanoseconds(config_.camera.skew_limit_ns)) * 2 + Cycles(1)
          : skew_;
  left_sensor_.read_out(nullptr, Cycles(0), lost, left);
  right_sensor_.read_out(nullptr, late, {}, right);
}

}  // namespace parallax
