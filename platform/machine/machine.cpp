// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "modules/output_packing.hpp"
#include "platform/machine/steady_state.hpp"
#include "tlm/bus_scheduler.hpp"
#include "tlm/dram_scheduler.hpp"

namespace parallax {
namespace {

std::unique_ptr<MemoryScheduler> memory_scheduler(const MemoryConfig& config, const ClockDomain& clock) {
  if (config.model == MemoryModel::kDram) return std::make_unique<DramScheduler>(config.dram_memory());
  BusTiming timing;
  timing.bytes_per_cycle = Bytes(config.bytes_per_cycle);
  timing.efficiency = config.efficiency;
  timing.latency = Cycles(config.latency_cycles);
  timing.arbitration = config.arbitration;
  return std::make_unique<BusScheduler>(timing, clock);
}

// None when another memory is brought along.
std::unique_ptr<Memory> make_memory(const MachineConfig& config, const MachineInput& input,
                                    const ClockDomain& clock) {
  if (input.bind_memory) return nullptr;
  MemoryTargetConfig target;
  target.size = Bytes(config.memory.size_bytes);
  target.queue_depth = config.memory.queue_depth;
  target.holds_data = !input.timing_only;
  return std::make_unique<Memory>("memory", target, memory_scheduler(config.memory, clock));
}

// Frames whose dates and activities are kept beyond the warm-up, at the beginning and at the end of a run:
// more than can be under way.
constexpr std::size_t kRecords = 160;
constexpr std::int64_t kShortestPause = 1000;  // ns, before software tries again to start the core

}  // namespace

Machine::Machine(const sc_core::sc_module_name& name, const MachineConfig& config, const MachineInput& input)
    : sc_module(name),
      config_(config),
      input_(input),
      tiles_(plan_tiles(config.tiles, config.matching.range(), input.width)),
      tiled_map_(tiles_.tiles.size() > 1 ? cut_map(*input.map, tiles_) : EncodedMap{}),
      memory_map_(lay_out_memory(config, input.width, input.height, map(),
                                 matcher_store(config, tiles_.width, input.height))),
      core_clock_("core", Hertz(config.clocks.core_hz)),
      memory_clock_("memory", Hertz(config.clocks.memory_hz)),
      camera_clock_("camera", Hertz(config.clocks.camera_hz)),
      link_clock_("link", Hertz(config.clocks.link_hz)),
      dataflow_("dataflow"),
      memory_(make_memory(config, input, memory_clock_)),
      acquisition_("acquisition", config_, input_, memory_map_, camera_clock_, dataflow_,
                   {[this](std::int64_t, bool values) {
                      values_.push_back(values);
                      times_.push_back({});
                      times_.back().exposed = sc_core::sc_time_stamp();
                      tell(static_cast<std::int64_t>(times_.size()) - 1, FrameStep::kExposed);
                    },
                    [this](std::int64_t frame) {
                      sc_core::sc_time& date = times_[static_cast<std::size_t>(frame)].first_byte;
                      if (date != sc_core::SC_ZERO_TIME) return;
                      date = sc_core::sc_time_stamp();
                      tell(frame, FrameStep::kFirstByte);
                    },
                    [this](std::int64_t frame) { frame_in_memory(frame); },
                    [this](CameraFault fault) { control_.frame_faulty(fault); }}),
      core_("core", config_, input_, {tiles_, map()}, core_clock_, dataflow_),
      transmission_("transmission", config_, input.width, input.height, link_clock_, dataflow_),
      ports_(collect_ports()),
      facts_(core_facts()),
      control_(
          "control", config_, facts_,
          {[this] { return offering_; }, [this](const FrameCommand& command) { core_started(command); }}),
      driver_("driver"),
      latencies_(steady_first(config, input.frames)) {
  const auto kept = static_cast<std::size_t>(warm_up_frames(config)) + kRecords;
  times_.keep(kept);
  snapshots_.keep(kept);
  core_.pipeline().keep_frames(kept);
  for (const MemoryPort* port : ports_) {
    if (memory_) {
      port->master->socket.bind(memory_->socket);
    } else {
      input.bind_memory(port->master->socket, port->name);
    }
  }
  driver_.socket.bind(control_.bank.socket);
  core_.pipeline().output().tap([this](const Disparity* row) { take_row(row); });
  SC_HAS_PROCESS(Machine);
  SC_METHOD(start_core);
  sensitive << start_;
  dont_initialize();
}

// The map is there before the first frame.
void Machine::start_of_simulation() {
  core_.find_stages();
  parts_ = collect_parts();
  if (input_.timing_only) return;
  ::tlm::tlm_generic_payload payload;
  std::vector<std::uint8_t> map_bytes = map().bytes;
  payload.set_command(::tlm::TLM_WRITE_COMMAND);
  payload.set_address(memory_map_.map);
  payload.set_data_ptr(map_bytes.data());
  payload.set_data_length(static_cast<unsigned>(map_bytes.size()));
  payload.set_streaming_width(payload.get_data_length());
  core_.map_port().master->socket->transport_dbg(payload);
}

void Machine::tell(std::int64_t frame, FrameStep step) {
  if (input_.step) input_.step(frame, step);
}

void Machine::frame_in_memory(std::int64_t frame) {
  times_[static_cast<std::size_t>(frame)].in_memory = sc_core::sc_time_stamp();
  tell(frame, FrameStep::kInMemory);
  ++in_memory_;
  start_when_possible();
}

// Called whenever something may have changed that the core's next frame waits for.
void Machine::start_when_possible() {
  const bool buffer = output_buffers_used_ < static_cast<std::int64_t>(memory_map_.outputs.size());
  const bool frame = !starting_ && started_ < in_memory_ && (in_core_ == 0 || config_.software.queue_frames);
  note_output_full(frame && !buffer);
  if (!frame || !buffer) return;
  starting_ = true;
  starting_since_ = sc_core::sc_time_stamp();
  ++output_buffers_used_;
  if (in_core_ == 0) core_taken_since_ = sc_core::sc_time_stamp();
  start_.notify(sc_core::sc_time(static_cast<double>(config_.software.response_ns), sc_core::SC_NS));
}

void Machine::note_output_full(bool full) {
  const sc_core::sc_time now = sc_core::sc_time_stamp();
  if (output_full_) output_full_time_ += now - output_full_since_;
  output_full_since_ = now;
  output_full_ = full;
}

// Software's part: registers, and another try when the core does not take the frame.
void Machine::start_core() {
  const std::int64_t frame = started_;
  std::optional<AlgorithmParameters> parameters;
  if (!parameters_written_) parameters = algorithm_parameters(config_);
  if (input_.parameters && frame < input_.frames) {
    if (const auto changed = input_.parameters(frame)) parameters = changed;
  }
  if (parameters) driver_.write_parameters(*parameters);
  parameters_written_ = true;
  const MemoryMap::FrameBuffer& buffer = acquisition_.buffer(frame);
  offering_ = true;
  const bool taken = driver_.start(
      {buffer.left, buffer.right, memory_map_.map, output_buffer(frame), memory_map_.buffer, {}}, facts_);
  offering_ = false;
  if (!taken) {
    ++rejected_starts_;
    const std::int64_t pause = std::max<std::int64_t>(config_.software.response_ns, kShortestPause);
    start_.notify(sc_core::sc_time(static_cast<double>(pause), sc_core::SC_NS));
    return;
  }
  start_when_possible();
}

// The core's part, within the write to its control register.
void Machine::core_started(const FrameCommand& command) {
  starting_ = false;
  starting_time_ += sc_core::sc_time_stamp() - starting_since_;
  ++in_core_;
  const std::int64_t frame = started_++;
  times_[static_cast<std::size_t>(frame)].core_started = sc_core::sc_time_stamp();
  tell(frame, FrameStep::kCoreStarted);
  CoreJob job;
  job.left = command.left;
  job.right = command.right;
  job.map = command.map;
  job.values = values_[static_cast<std::size_t>(frame)];
  job.parameters = command.parameters;
  job.output = command.output;
  job.buffer = command.buffer;
  job.left_source = image_source(acquisition_.left_progress(), frame);
  job.right_source = image_source(acquisition_.right_progress(), frame);
  job.read = [this] { acquisition_.release(); };
  job.written = [this, frame] { results_in_memory(frame); };
  if (core_.output_progress()) job.early = [this, frame] { send_results(frame); };
  core_.start(job);
}

ImageSource Machine::image_source(const std::shared_ptr<TransferProgress>& progress,
                                  std::int64_t frame) const {
  if (!progress) return {};
  return {progress, acquisition_.bursts_before(frame), Bytes(config_.dma.camera.burst_bytes)};
}

CoreFacts Machine::core_facts() {
  CoreFacts facts;
  facts.width = input_.width;
  facts.height = input_.height;
  facts.image_bytes = bytes_of(config_.camera.format, static_cast<std::uint64_t>(input_.width)) *
                      static_cast<std::uint64_t>(input_.height);
  const auto rows = static_cast<std::uint64_t>(input_.height);
  const std::uint64_t early = config_.camera.early_start_rows;
  facts.start_bytes = facts.image_bytes / rows * (early == 0 ? rows : std::min(early, rows));
  facts.map_bytes = map().bytes.size();
  facts.output_bytes = OutputPacking::row_bytes(input_.width, config_.link.output_left()) *
                       static_cast<std::uint64_t>(input_.height);
  facts.buffer_bytes = core_.pipeline().store().bytes();
  facts.memory_bytes = static_cast<std::uint64_t>(config_.memory.size_bytes);
  const auto port = [](BusMaster& master, const DmaPortConfig& config) {
    return CoreFacts::Port{&master, config.outstanding};
  };
  const std::vector<MemoryPort>& ports = core_.ports();
  facts.left = port(*ports[0].master, config_.dma.left);
  facts.right = port(*ports[1].master, config_.dma.right);
  facts.map = port(*ports[2].master, config_.dma.map);
  facts.output = port(*ports[3].master, config_.dma.output);
  for (const MemoryPort& p : core_.buffer_ports()) facts.buffer.push_back({p.master, p.slots});
  return facts;
}

std::uint64_t Machine::output_buffer(std::int64_t frame) const {
  return memory_map_.outputs[static_cast<std::size_t>(frame) % memory_map_.outputs.size()];
}

void Machine::results_in_memory(std::int64_t frame) {
  FrameTimes& times = times_[static_cast<std::size_t>(frame)];
  times.results_in_memory = sc_core::sc_time_stamp();
  tell(frame, FrameStep::kResultsInMemory);
  core_taken_ = core_taken();
  core_taken_since_ = sc_core::sc_time_stamp();
  --in_core_;
  control_.frame_done();
  const StageInfo filter = pipeline().last_filter();
  const auto index = static_cast<std::size_t>(frame);
  times.first_disparity = core_clock_.time_of(filter.first_pass(index).first_write);
  times.last_disparity = core_clock_.time_of(filter.last_pass(index).last_write);

  if (!core_.output_progress()) send_results(frame);
  start_when_possible();
}

// Of which all, or link.early_start_rows, are in memory.
void Machine::send_results(std::int64_t frame) {
  DmaJob job;
  job.address = output_buffer(frame);
  job.row_bytes.assign(
      static_cast<std::size_t>(input_.height),
      static_cast<std::uint32_t>(OutputPacking::row_bytes(input_.width, config_.link.output_left())));
  job.values = values_[static_cast<std::size_t>(frame)];
  if (const auto& progress = core_.output_progress()) {
    job.behind = progress;
    const std::uint64_t before = static_cast<std::uint64_t>(frame) *
                                 core_.output_bursts_until(static_cast<std::uint64_t>(input_.height));
    job.needed = [this, before, row = std::uint64_t{job.row_bytes.front()}](std::uint64_t last_byte) {
      return before + core_.output_bursts_until((last_byte + row - 1) / row);
    };
  }
  transmission_.start(std::move(job),
                      [this, frame](const std::vector<std::uint8_t>& sent) { deliver(frame, sent); });
}

// Rows come tile by tile, each with all columns of its tile.
void Machine::take_row(const Disparity* row) {
  const auto width = static_cast<std::size_t>(input_.width);
  const auto height = static_cast<std::size_t>(input_.height);
  labelled_rows_.resize(width * height);
  const Tile& tile = tiles_.tiles[rows_taken_ / height];
  std::copy(
      row + (tile.keep_begin - tile.begin), row + (tile.keep_end - tile.begin),
      labelled_rows_.begin() + static_cast<std::ptrdiff_t>(rows_taken_ % height * width) + tile.keep_begin);
  if (++rows_taken_ == tiles_.tiles.size() * height) {
    rows_taken_ = 0;
    labelled_.push_back(std::move(labelled_rows_));
    labelled_rows_.clear();
  }
}

void Machine::deliver(std::int64_t frame, const std::vector<std::uint8_t>& bytes) {
  FrameTimes& times = times_[static_cast<std::size_t>(frame)];
  times.at_host = sc_core::sc_time_stamp();
  tell(frame, FrameStep::kAtHost);
  latencies_.add(static_cast<std::size_t>(frame), times);
  snapshots_.push_back(snapshot());
  --output_buffers_used_;
  start_when_possible();
  FrameResult result;
  result.index = frame;
  if (!bytes.empty()) {
    const auto width = static_cast<std::size_t>(input_.width);
    const std::size_t row_bytes = OutputPacking::row_bytes(input_.width, config_.link.output_left());
    std::vector<std::uint16_t> values(width);
    result.disparities = std::move(labelled_.front());
    labelled_.pop_front();
    result.left.resize(result.disparities.size());
    for (std::size_t y = 0; y < static_cast<std::size_t>(input_.height); ++y) {
      unpack_output(bytes.data() + y * row_bytes, input_.width, config_.link.output_left(),
                    result.left.data() + y * width, values.data());
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
  if (++delivered_ < input_.frames) return;
  input_.finished ? input_.finished() : sc_core::sc_stop();
}

std::vector<MemoryPort*> Machine::collect_ports() {
  std::vector<MemoryPort*> all;
  const auto add = [&all](MemoryPort& port) {
    port.number = all.size();
    all.push_back(&port);
  };
  for (MemoryPort& port : acquisition_.ports()) add(port);
  for (MemoryPort& port : core_.ports()) add(port);
  add(transmission_.port());
  for (MemoryPort& port : core_.buffer_ports()) add(port);
  return all;
}

std::vector<Part> Machine::collect_parts() const {
  std::vector<Part> all;
  const auto add = [&all](const std::vector<Part>& parts) {
    all.insert(all.end(), parts.begin(), parts.end());
  };
  if (memory_) {
    Part memory{PartKind::kMemory,
                "memory",
                config_.memory.model == MemoryModel::kDram ? "memory.device" : "memory.bytes_per_cycle",
                {Relief::kMemory, Relief::kMemoryClock}};
    memory.core_waits = true;
    all.push_back(memory);
  }
  add(acquisition_.parts());
  for (const MemoryPort* port : ports_) all.push_back(port->part());
  if (config_.software.response_ns > 0) {
    all.push_back({PartKind::kSoftware, "software", "software.response_ns", {Relief::kSoftware}});
  }
  add(core_.parts());
  add(transmission_.parts());
  return all;
}

const Part* Machine::find_part(const std::string& name) const {
  const auto found =
      std::find_if(parts_.begin(), parts_.end(), [&](const Part& p) { return p.name == name; });
  return found == parts_.end() ? nullptr : &*found;
}

sc_core::sc_time Machine::core_taken() const {
  if (in_core_ == 0 && !starting_) return core_taken_;
  return core_taken_ + (sc_core::sc_time_stamp() - core_taken_since_);
}

MachineSnapshot Machine::snapshot() {
  MachineSnapshot snapshot;
  snapshot.time = sc_core::sc_time_stamp();
  for (std::size_t port = 0; port < ports_.size(); ++port) {
    const BusMaster& master = *ports_[port]->master;
    snapshot.ports.push_back(
        {master.statistics().bytes, memory_ ? memory_->bus_taken(port) : Cycles(0), master.occupied()});
  }
  if (memory_) {
    snapshot.memory = memory_->at_work();
    if (const DramStatistics* commands = memory_->commands()) snapshot.dram = *commands;
  }
  snapshot.camera = sensor().busy();
  snapshot.cameras = acquisition_.counts();
  snapshot.software = starting_time_ + (starting_ ? snapshot.time - starting_since_ : sc_core::SC_ZERO_TIME);
  snapshot.core = core_taken();
  note_output_full(output_full_);
  snapshot.output_full = output_full_time_;
  snapshot.wire = link().wire_busy();
  snapshot.host = link().host_busy();
  return snapshot;
}

}  // namespace parallax
