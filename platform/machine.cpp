// SPDX-License-Identifier: Apache-2.0
#include "platform/machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace parallax {
namespace {

MemoryTiming memory_timing(const MemoryConfig& config, bool holds_data) {
  MemoryTiming timing;
  timing.holds_data = holds_data;
  timing.size = Bytes(config.size_bytes);
  timing.bytes_per_cycle = Bytes(config.bytes_per_cycle);
  timing.efficiency = config.efficiency;
  timing.latency = Cycles(config.latency_cycles);
  timing.queue_depth = config.queue_depth;
  timing.arbitration = config.arbitration == Arbitration::kRoundRobin
                           ? MemoryTiming::Arbitration::kRoundRobin
                           : MemoryTiming::Arbitration::kFixedPriority;
  return timing;
}

// A row takes its pixels and the blanking at the pixel clock, or as long as the cable needs for it.
SensorConfig sensor_config(const MachineConfig& config, const MachineInput& input) {
  const std::int64_t read_out = std::int64_t{input.width} + config.camera.row_blanking;
  const std::int64_t cable =
      (std::int64_t{input.width} * config.clocks.camera_hz + config.camera.bytes_per_second - 1) /
      config.camera.bytes_per_second;
  SensorConfig sensor;
  sensor.width = input.width;
  sensor.height = input.height;
  sensor.row = Cycles(std::max(read_out, cable));
  sensor.frame_blanking = Cycles(config.camera.frame_blanking);
  sensor.burst = Bytes(config.dma.camera.burst_bytes);
  return sensor;
}

// Calls `then` at the second of two calls.
std::function<void()> when_both(std::function<void()> then) {
  auto first = std::make_shared<bool>(true);
  return [first, then = std::move(then)] {
    if (!std::exchange(*first, false)) then();
  };
}

std::vector<std::uint32_t> equal_rows(int rows, std::size_t bytes) {
  return std::vector<std::uint32_t>(static_cast<std::size_t>(rows), static_cast<std::uint32_t>(bytes));
}

}  // namespace

const std::vector<const char*>& Machine::port_names() {
  static const std::vector<const char*> names{"camera_left", "camera_right", "left", "right",
                                              "map",         "output",       "link"};
  return names;
}

Machine::Machine(const sc_core::sc_module_name& name, const MachineConfig& config, const MachineInput& input)
    : sc_module(name),
      config_(config),
      input_(input),
      memory_map_(lay_out_memory(config, input.width, input.height, *input.map)),
      core_clock_("core", Hertz(config.clocks.core_hz)),
      memory_clock_("memory", Hertz(config.clocks.memory_hz)),
      camera_clock_("camera", Hertz(config.clocks.camera_hz)),
      link_clock_("link", Hertz(config.clocks.link_hz)),
      dataflow_("dataflow"),
      memory_("memory", memory_timing(config.memory, !input.timing_only), memory_clock_),
      left_sensor_("left_sensor", sensor_config(config, input), camera_clock_, dataflow_),
      right_sensor_("right_sensor", sensor_config(config, input), camera_clock_, dataflow_),
      dma_camera_left_("dma_camera_left", engine_config(config.dma.camera), camera_clock_),
      dma_camera_right_("dma_camera_right", engine_config(config.dma.camera), camera_clock_),
      dma_left_("dma_left", engine_config(config.dma.left), core_clock_),
      dma_right_("dma_right", engine_config(config.dma.right), core_clock_),
      dma_map_("dma_map", engine_config(config.dma.map), core_clock_),
      dma_output_("dma_output", engine_config(config.dma.output), core_clock_),
      dma_link_("dma_link", engine_config(config.dma.link), link_clock_),
      pipeline_("pipeline", config_, *input.map, {core_clock_, dataflow_, input.width, input.height}),
      link_("link", config.link, Bytes(config.dma.link.burst_bytes), link_clock_),
      camera_left_bursts_("camera_left_bursts", dataflow_, camera_clock_, camera_clock_,
                          engine_config(config.dma.camera).fifo()),
      camera_right_bursts_("camera_right_bursts", dataflow_, camera_clock_, camera_clock_,
                           engine_config(config.dma.camera).fifo()),
      link_bursts_("link_bursts", dataflow_, link_clock_, link_clock_,
                   engine_config(config.dma.link).fifo()) {
  left_sensor_.out_bursts(camera_left_bursts_);
  right_sensor_.out_bursts(camera_right_bursts_);
  dma_camera_left_.in_bursts(camera_left_bursts_);
  dma_camera_right_.in_bursts(camera_right_bursts_);
  pipeline_.bind(dma_left_.out_bursts, dma_right_.out_bursts, dma_map_.out_bursts, dma_output_.in_bursts);
  dma_link_.out_bursts(link_bursts_);
  link_.in_bursts(link_bursts_);

  for (BusMaster* master : masters()) master->socket.bind(memory_.socket);
  pipeline_.output().tap([this](const Disparity* row) { take_row(row); });

  SC_HAS_PROCESS(Machine);
  SC_THREAD(expose_frames);
}

// The map is there before the first frame; then a frame is exposed whenever a buffer is free and its time has
// come. Nothing that has to be freed lives on this thread's stack while it waits: it never ends.
void Machine::expose_frames() {
  if (!input_.timing_only) place_map();
  for (std::int64_t frame = 0;; ++frame) {
    wait_for_input_buffer();
    if (config_.camera.frame_rate > 0) {
      const double due = static_cast<double>(frame) / config_.camera.frame_rate;
      camera_clock_.wait_until(
          Cycles(static_cast<std::int64_t>(due * static_cast<double>(config_.clocks.camera_hz))));
    }
    expose(frame);
    sc_core::wait(frame_complete_);
    const Cycles read_out = left_sensor_.frame_time();
    camera_clock_.wait_until(camera_clock_.cycle_at_or_after(times_.back().exposed) + read_out);
  }
}

void Machine::wait_for_input_buffer() {
  waits_for_buffer_ = true;
  buffer_wait_began_ = sc_core::sc_time_stamp();
  while (input_buffers_used_ == static_cast<std::int64_t>(memory_map_.frames.size())) {
    sc_core::wait(input_buffer_free_);
  }
  waits_for_buffer_ = false;
  buffer_wait_ += sc_core::sc_time_stamp() - buffer_wait_began_;
}

void Machine::place_map() {
  ::tlm::tlm_generic_payload map;
  std::vector<std::uint8_t> map_bytes = input_.map->bytes;
  map.set_command(::tlm::TLM_WRITE_COMMAND);
  map.set_address(memory_map_.map);
  map.set_data_ptr(map_bytes.data());
  map.set_data_length(static_cast<unsigned>(map_bytes.size()));
  map.set_streaming_width(map.get_data_length());
  dma_map_.master.socket->transport_dbg(map);
}

void Machine::expose(std::int64_t frame) {
  const std::vector<std::uint32_t> rows = equal_rows(input_.height, static_cast<std::size_t>(input_.width));
  ++input_buffers_used_;
  const StereoFrame images = frame < input_.frames && input_.expose ? input_.expose(frame) : StereoFrame{};
  const bool values = images.left != nullptr;
  values_.push_back(values);
  times_.emplace_back();
  times_.back().exposed = sc_core::sc_time_stamp();
  const std::function<void()> done = when_both([this, frame] {
    frame_complete_.notify();
    frame_in_memory(frame);
  });
  const auto buffers = static_cast<std::int64_t>(memory_map_.frames.size());
  const MemoryMap::FrameBuffer& buffer = memory_map_.frames[static_cast<std::size_t>(frame % buffers)];
  dma_camera_left_.start({buffer.left, rows, values, done});
  dma_camera_right_.start({buffer.right, rows, values, done});
  left_sensor_.read_out(images.left);
  right_sensor_.read_out(images.right);
}

void Machine::frame_in_memory(std::int64_t frame) {
  times_[static_cast<std::size_t>(frame)].in_memory = sc_core::sc_time_stamp();
  const auto buffers = static_cast<std::int64_t>(memory_map_.frames.size());
  const MemoryMap::FrameBuffer& buffer = memory_map_.frames[static_cast<std::size_t>(frame % buffers)];
  const std::vector<std::uint32_t> rows = equal_rows(input_.height, static_cast<std::size_t>(input_.width));
  const bool values = values_[static_cast<std::size_t>(frame)];
  const std::function<void()> read = when_both([this] {
    --input_buffers_used_;
    input_buffer_free_.notify();
  });
  dma_left_.start({buffer.left, rows, values, read});
  dma_right_.start({buffer.right, rows, values, read});
  dma_map_.start({memory_map_.map, input_.map->row_bytes, values, nullptr});
  ++processing_;
  start_outputs();
}

// Gives output buffers to the frames that are being processed, in order.
void Machine::start_outputs() {
  const auto buffers = static_cast<std::int64_t>(memory_map_.outputs.size());
  while (to_output_ < processing_ && output_buffers_used_ < buffers) {
    const std::int64_t frame = to_output_++;
    ++output_buffers_used_;
    dma_output_.start({memory_map_.outputs[static_cast<std::size_t>(frame % buffers)],
                       equal_rows(input_.height, OutputPacking::row_bytes(input_.width)),
                       values_[static_cast<std::size_t>(frame)],
                       [this, frame] { results_in_memory(frame); }});
  }
}

void Machine::results_in_memory(std::int64_t frame) {
  FrameTimes& times = times_[static_cast<std::size_t>(frame)];
  times.results_in_memory = sc_core::sc_time_stamp();
  const FrameDates& dates = pipeline_.last_filter().frames()[static_cast<std::size_t>(frame)];
  times.first_disparity = core_clock_.time_of(dates.first_write);
  times.last_disparity = core_clock_.time_of(dates.last_write);

  const auto buffers = static_cast<std::int64_t>(memory_map_.outputs.size());
  DmaJob job;
  job.address = memory_map_.outputs[static_cast<std::size_t>(frame % buffers)];
  job.row_bytes = equal_rows(input_.height, OutputPacking::row_bytes(input_.width));
  job.values = values_[static_cast<std::size_t>(frame)];
  if (config_.link.enabled) {
    const std::uint64_t bytes = job.bytes();
    const bool values = job.values;
    dma_link_.start(std::move(job));
    link_.start(
        {bytes, values, [this, frame](const std::vector<std::uint8_t>& sent) { deliver(frame, sent); }});
    return;
  }
  std::vector<std::uint8_t> bytes;
  if (job.values) {
    bytes.resize(job.bytes());
    dma_link_.master.read_now(job.address, bytes.data(), bytes.size());
  }
  deliver(frame, bytes);
}

void Machine::take_row(const Disparity* row) {
  labelled_rows_.insert(labelled_rows_.end(), row, row + input_.width);
  const auto pixels = static_cast<std::size_t>(input_.width) * static_cast<std::size_t>(input_.height);
  if (labelled_rows_.size() == pixels) {
    labelled_.push_back(std::move(labelled_rows_));
    labelled_rows_.clear();
  }
}

void Machine::deliver(std::int64_t frame, const std::vector<std::uint8_t>& bytes) {
  times_[static_cast<std::size_t>(frame)].at_host = sc_core::sc_time_stamp();
  activities_.push_back(activity());
  --output_buffers_used_;
  start_outputs();
  FrameResult result;
  result.index = frame;
  if (!bytes.empty()) {
    const auto width = static_cast<std::size_t>(input_.width);
    const std::size_t row_bytes = OutputPacking::row_bytes(input_.width);
    std::vector<std::uint16_t> values(width);
    result.disparities = std::move(labelled_.front());
    labelled_.pop_front();
    result.left.resize(result.disparities.size());
    for (std::size_t y = 0; y < static_cast<std::size_t>(input_.height); ++y) {
      unpack_output(bytes.data() + y * row_bytes, input_.width, result.left.data() + y * width,
                    values.data());
      for (std::size_t x = 0; x < width; ++x) {
        if (result.disparities[y * width + x].value != values[x]) {
          SC_REPORT_ERROR(
              "/parallax/machine/values",
              fmt::format("frame {}: the host's disparity at ({}, {}) is not the pipeline's", frame, x, y)
                  .c_str());
        }
      }
    }
  }
  if (input_.deliver) input_.deliver(result);
  if (++delivered_ == input_.frames) sc_core::sc_stop();
}

std::vector<BusMaster*> Machine::masters() {
  return {&dma_camera_left_.master, &dma_camera_right_.master, &dma_left_.master, &dma_right_.master,
          &dma_map_.master,         &dma_output_.master,       &dma_link_.master};
}

std::vector<std::uint32_t> Machine::dma_places() const {
  // A reading engine has no more requests under way than its FIFO can take answers.
  const auto reading = [](const DmaPortConfig& port) {
    return std::min(port.outstanding, engine_config(port).fifo_bursts);
  };
  const DmaConfig& dma = config_.dma;
  return {dma.camera.outstanding, dma.camera.outstanding, reading(dma.left), reading(dma.right),
          reading(dma.map),       dma.output.outstanding, reading(dma.link)};
}

Activity Machine::activity() {
  Activity activity;
  activity.time = sc_core::sc_time_stamp();
  const std::vector<BusMaster*> engines = masters();
  for (std::size_t port = 0; port < memory_.ports(); ++port) {
    activity.ports.push_back(
        {memory_.statistics(port).bytes(), memory_.bus_taken(port), engines[port]->occupied()});
  }
  activity.camera = left_sensor_.busy();
  activity.buffer_wait = buffer_wait_;
  if (waits_for_buffer_) activity.buffer_wait += activity.time - buffer_wait_began_;
  activity.wire = link_.wire_busy();
  activity.host = link_.host_busy();
  return activity;
}

}  // namespace parallax
