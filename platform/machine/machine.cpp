// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/machine.hpp"

#include <memory>

#include "tlm/bus_scheduler.hpp"
#include "tlm/dram_scheduler.hpp"

namespace parallax {
namespace {

std::unique_ptr<MemoryScheduler> memory_scheduler(const MemoryConfig& config, const ClockDomain& clock) {
  if (config.model == MemoryModel::kDram) return std::make_unique<DramScheduler>(config.dram_memory());
  BusTiming timing;
  timing.bytes_per_cycle = Bytes(config.bytes_per_cycle);
  timing.efficiency = config.efficiency;
  timing.latency = config.latency(clock);
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

}  // namespace

Machine::Machine(const sc_core::sc_module_name& name, const MachineConfig& config, const MachineInput& input)
    : sc_module(name),
      config_(config),
      input_(input),
      tiles_(plan_tiles(config.tiles, config.matching.range(), input.width, config.timing.pixels_per_token)),
      tiled_map_(tiles_.tiles.size() > 1 ? cut_map(*input.map, tiles_) : EncodedMap{}),
      memory_map_(lay_out_memory(config, input.width, input.height, map(),
                                 matcher_store(config, tiles_.width, input.height))),
      core_clock_("core", Hertz(config.clocks.core_hz)),
      memory_clock_("memory", Hertz(config.clocks.memory_hz)),
      camera_clock_("camera", Hertz(config.clocks.camera_hz)),
      link_clock_("link", Hertz(config.clocks.link_hz)),
      dataflow_("dataflow"),
      ledger_(config, input.frames, input.step),
      memory_(make_memory(config, input, memory_clock_)),
      acquisition_("acquisition", config_, input_, memory_map_, camera_clock_, dataflow_,
                   acquisition_hooks()),
      core_("core", config_, input_, {tiles_, map(), acquisition_.left_writer(), acquisition_.right_writer()},
            core_hooks(), core_clock_, dataflow_),
      transmission_(
          "transmission", config_, {input.width, input.height, core_.output_writer()}, link_clock_, dataflow_,
          [this](std::int64_t frame, const std::vector<std::uint8_t>& bytes) { received(frame, bytes); }),
      software_("software", config_, input_, memory_map_, core_.facts(),
                [this](std::int64_t frame, std::uint64_t address) {
                  transmission_.send(frame, address, ledger_.has_values(frame));
                }),
      host_(input_, tiles_, config_.link.output_left(),
            [this] { return input_.enough ? input_.enough(*this) : settled(); }),
      ports_(collect_ports()),
      watchdog_("watchdog", watched()) {
  core_.pipeline().keep_frames(ledger_.kept());
  for (const MemoryPort* port : ports_) {
    if (memory_) {
      port->master->socket.bind(memory_->socket);
    } else {
      input.bind_memory(port->master->socket, port->name);
    }
  }
  software_.driver.socket.bind(core_.control().bank.socket);
}

Acquisition::Hooks Machine::acquisition_hooks() {
  Acquisition::Hooks hooks;
  hooks.exposed = [this](std::int64_t, const sc_core::sc_time& due, std::int64_t lost, bool values) {
    ledger_.exposed(due, lost, values);
  };
  hooks.begun = [this](std::int64_t frame) { ledger_.first_byte(frame); };
  hooks.startable = [this](std::int64_t frame) {
    ledger_.startable(frame);
    software_.frame_startable();
  };
  hooks.in_memory = [this](std::int64_t frame) { ledger_.in_memory(frame); };
  hooks.faulty = [this](CameraFault fault) { core_.control().frame_faulty(fault); };
  return hooks;
}

StereoCore::Hooks Machine::core_hooks() {
  StereoCore::Hooks hooks;
  hooks.expected = [this] { return software_.offers(); };
  hooks.has_values = [this](std::int64_t frame) { return ledger_.has_values(frame); };
  hooks.started = [this](std::int64_t frame) {
    software_.core_started();
    ledger_.core_started(frame);
  };
  hooks.read = [this] {
    ledger_.images_read();
    acquisition_.release();
  };
  hooks.begun = [this](std::int64_t frame) { software_.results_begun(frame); };
  hooks.written = [this](std::int64_t frame, const CoreDates& dates) {
    ledger_.results_in_memory(frame, dates.first_disparity, dates.last_disparity);
    software_.core_ended(frame);
  };
  return hooks;
}

void Machine::received(std::int64_t frame, const std::vector<std::uint8_t>& bytes) {
  const std::size_t before = latencies().steady_first();
  ledger_.at_host(frame);
  ledger_.add(snapshot());
  if (const std::size_t first = latencies().steady_first(); first != before)
    core_.pipeline().pin_frame(first);
  software_.output_buffer_free();
  host_.receive(frame, bytes);
}

// The map is there before the first frame.
void Machine::start_of_simulation() {
  core_.find_stages();
  parts_ = collect_parts();
  start_watchdog();
  if (input_.timing_only) return;
  core_.pipeline().results().add_row_listener(host_);
  ::tlm::tlm_generic_payload payload;
  std::vector<std::uint8_t> map_bytes = map().bytes;
  payload.set_command(::tlm::TLM_WRITE_COMMAND);
  payload.set_address(memory_map_.map);
  payload.set_data_ptr(map_bytes.data());
  payload.set_data_length(static_cast<unsigned>(map_bytes.size()));
  payload.set_streaming_width(payload.get_data_length());
  map_port().master->socket->transport_dbg(payload);
}

std::vector<MemoryPort*> Machine::collect_ports() {
  std::vector<MemoryPort*> all;
  const auto add = [&all](MemoryPort& port) {
    port.number = all.size();
    all.push_back(&port);
  };
  for (MemoryPort& port : acquisition_.ports()) add(port);
  for (MemoryPort* port : core_.ports()) add(*port);
  add(transmission_.port());
  for (MemoryPort* port : core_.store_ports()) add(*port);
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
  add(software_.parts());
  add(core_.parts());
  add(transmission_.parts());
  return all;
}

MachineSnapshot Machine::snapshot() {
  MachineSnapshot snapshot;
  snapshot.time = sc_core::sc_time_stamp();
  for (const MemoryPort* port : ports_) {
    snapshot.ports.push_back({port->master->statistics().bytes,
                              memory_ ? memory_->bus_taken(port->number) : Cycles(0),
                              port->master->occupied()});
  }
  if (memory_) {
    snapshot.memory = memory_->at_work();
    if (const DramStatistics* commands = memory_->commands()) snapshot.dram = *commands;
  }
  snapshot.camera = sensor().busy();
  snapshot.cameras = acquisition_.counts();
  snapshot.software = software_.starting_time();
  snapshot.core = software_.core_time();
  snapshot.output_full = software_.output_full_time();
  snapshot.wire = link().wire_busy();
  snapshot.host = link().host_busy();
  return snapshot;
}

}  // namespace parallax
