// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/machine_fifos.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <systemc>

#include "platform/config/stream_config.hpp"
#include "platform/evaluation/own_process.hpp"
#include "platform/machine/machine.hpp"
#include "platform/machine/steady_state.hpp"
#include "tlm/deadlock.hpp"

namespace parallax {
namespace {

using Json = nlohmann::ordered_json;

MachineInput machine_input(const MachineConfig& config, const EvaluationInput& input) {
  MachineInput made;
  made.width = input.map->width;
  made.height = input.map->height;
  made.map = input.map;
  made.frames = run_length(config, input.frames, input.timing_frames).least;
  made.timing_only = true;
  return made;
}

MachineConfig with_depths(MachineConfig config, std::uint32_t tokens) {
  for (StreamDepth& depth : config.streams.depths) depth.tokens = tokens;
  return config;
}

std::vector<const StreamBase*> fifos_of(const Machine& machine) {
  const std::vector<std::string>& names = pipeline_stream_names();
  std::vector<const StreamBase*> all;
  for (const std::string& name : names) {
    for (const StreamBase* stream : machine.dataflow().streams()) {
      if (!stream->inside_stage() && stream->basename() == name) all.push_back(stream);
    }
  }
  return all;
}

// In a process of its own.
std::string describe(const MachineConfig& config, const EvaluationInput& input) {
  const Machine machine("machine", config, machine_input(config, input));
  const MachineConfig automatic = with_depths(config, 0);
  const Machine derived("derived", automatic, machine_input(automatic, input));
  const std::vector<const StreamBase*> now = fifos_of(machine), then = fifos_of(derived);
  Json all = Json::array();
  for (std::size_t i = 0; i < now.size(); ++i) {
    const StreamBase& stream = *now[i];
    all.push_back({{"stream", stream.basename()},
                   {"kind", name_of(stream.config().kind)},
                   {"width", stream.width().count()},
                   {"depth", stream.depth()},
                   {"automatic", then[i]->depth()},
                   {"write_to_read", stream.config().write_to_read},
                   {"read_to_write", stream.config().read_to_write}});
  }
  return all.dump();
}

// Likewise: what frees the machine all of whose FIFOs have one slot.
std::string free_of_deadlock(const MachineConfig& config, const EvaluationInput& input) {
  const MachineConfig shallow = with_depths(config, 1);
  const Machine machine("machine", shallow, machine_input(shallow, input));
  sc_core::sc_start(sc_core::SC_ZERO_TIME);
  Json all = Json::object();
  const std::uint64_t frames = machine.input().frames * machine.tiles().tiles.size();
  for (const Remedy::Depth& depth : smallest_remedy(machine.dataflow(), frames).depths)
    all[depth.stream->basename()] = depth.tokens;
  return all.dump();
}

}  // namespace

std::optional<std::vector<MachineFifo>> machine_fifos(const MachineConfig& config,
                                                      const EvaluationInput& input,
                                                      const std::function<bool()>& interrupted) {
  const std::optional<std::string> described =
      in_own_process([&] { return describe(config, input); }, interrupted);
  if (!described) return std::nullopt;
  const std::optional<std::string> freed =
      in_own_process([&] { return free_of_deadlock(config, input); }, interrupted);
  if (!freed) return std::nullopt;
  const Json depths = Json::parse(*freed);
  std::vector<MachineFifo> all;
  for (const Json& entry : Json::parse(*described)) {
    MachineFifo fifo;
    fifo.stream = entry.at("stream");
    fifo.kind = entry.at("kind");
    fifo.width = entry.at("width");
    fifo.depth = entry.at("depth");
    fifo.automatic = entry.at("automatic");
    fifo.write_to_read = entry.at("write_to_read");
    fifo.read_to_write = entry.at("read_to_write");
    fifo.deadlock_free = depths.value(fifo.stream, std::int64_t{1});
    all.push_back(std::move(fifo));
  }
  return all;
}

}  // namespace parallax
