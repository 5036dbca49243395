// SPDX-License-Identifier: Apache-2.0
#include "platform/results/energy.hpp"

#include <algorithm>
#include <cstring>

namespace parallax {
namespace {

constexpr double kPico = 1e-12;
constexpr double kNano = 1e-9;
constexpr double kBitsPerByte = 8;

double count_of(unsigned set) {
  double count = 0;
  for (; set != 0; set &= set - 1) ++count;
  return count;
}

struct StageBits {  // of one frame
  double read = 0;
  double fifo = 0;  // written and read
};

// FIFOs to and from memory ports are left out: what they move is what the ports count.
StageBits stage_bits(const StageInfo& info) {
  const Schedule& schedule = info.stage->schedule();
  StageBits bits;
  for (unsigned port = 0; port < Stage::kMaxPorts; ++port) {
    const double read = static_cast<double>(schedule.consumed(port) * info.passes);
    for (const StreamBase* stream : info.stage->input_streams(port)) {
      if (!stream->at_memory()) bits.read += read * stream->width().real();
    }
    const double written = static_cast<double>(schedule.produced(port) * info.passes);
    for (const StreamBase* stream : info.stage->output_streams(port)) {
      if (!stream->at_memory()) bits.fifo += written * stream->width().real();
    }
  }
  bits.fifo += bits.read;
  return bits;
}

// What each frame does in the core, for `activity.frames` of them.
void add_core(EnergyActivity& activity, const Machine& machine) {
  const MachineConfig& config = machine.config();
  const auto tiles = static_cast<double>(machine.tiles().tiles.size());
  const double rows = tiles * machine.input().height;
  const double evaluations = rows * machine.tiles().width * config.matching.range().count;
  const double passes = (config.matching.paths & kSouthernPaths) == 0 ? 1 : 2;  // each compares the codes
  activity.census_bits = activity.frames * passes * evaluations * config.census.code_bits();
  activity.path_updates = activity.frames * evaluations * count_of(config.matching.paths);
  double bits = 0;
  for (const StageInfo& info : machine.pipeline().stages()) {
    const StageBits stage = stage_bits(info);
    if (!machine.pipeline().is_matcher(*info.stage) && info.enabled)
      activity.stage_bits += activity.frames * stage.read;
    bits += stage.fifo + 2 * info.storage.real() * rows;
  }
  activity.on_chip_bytes += activity.frames * bits / kBitsPerByte;
}

}  // namespace

EnergyActivity energy_activity(const Machine& machine, const SteadyWindow& window) {
  const MachineSnapshot& last = machine.snapshots()[window.last];
  MachineSnapshot first;
  first.ports.resize(last.ports.size());
  if (window.frames() > 0) first = machine.snapshots()[window.first];

  EnergyActivity activity;
  activity.seconds = (last.time - first.time).to_seconds();
  activity.frames = window.divisor();
  activity.core_cycles = activity.seconds * static_cast<double>(machine.config().clocks.core_hz);
  for (const MemoryPort* port : machine.ports()) {
    const auto bytes = static_cast<double>(last.ports[port->number].bytes - first.ports[port->number].bytes);
    activity.memory_bytes += bytes;
    if (port->from_camera()) activity.camera_bytes += bytes;
  }
  if (machine.memory() != nullptr && machine.memory()->commands() != nullptr) {
    activity.rows_opened = static_cast<double>(last.dram.activates - first.dram.activates);
  }
  activity.on_chip_bytes = 2 * activity.memory_bytes;
  activity.link = machine.config().link.enabled;
  activity.link_bits = machine.link_clock().seconds(last.wire - first.wire) *
                       static_cast<double>(machine.config().link.line_rate);
  add_core(activity, machine);
  return activity;
}

double EnergyEstimate::joules() const {
  double sum = 0;
  for (const Part& part : parts) sum += part.joules;
  return sum;
}

EnergyEstimate estimate_energy(const EnergyConfig& config, const EnergyActivity& activity) {
  EnergyEstimate estimate;
  estimate.seconds = activity.seconds;
  estimate.frames = activity.frames;
  const double s = activity.seconds;
  const double opened = activity.rows_opened.value_or(activity.memory_bytes / config.dram_access_bytes *
                                                      (1 - config.dram_row_hits / 100));
  const double transfers = activity.memory_bytes * kBitsPerByte * config.dram_bit_pj * kPico;
  const double link = config.link_w * s + activity.link_bits * config.link_bit_pj * kPico;
  estimate.parts = {
      {"matcher", "the matcher's census comparisons and path updates",
       (activity.census_bits * config.census_bit_pj + activity.path_updates * config.path_update_pj) * kPico},
      {"stages", "all other stages, by the bits that they read",
       activity.stage_bits * config.stage_bit_pj * kPico},
      {"clock", "the core's clock network, at work or not",
       activity.core_cycles * config.core_cycle_pj * kPico},
      {"on_chip_memory", "line buffers and FIFOs", activity.on_chip_bytes * config.on_chip_byte_pj * kPico},
      {"memory", "the DRAM: background, rows opened, bits moved",
       config.dram_background_w * s + opened * config.dram_activate_nj * kNano + transfers},
      {"link", "the Ethernet transceiver and the bits sent", activity.link ? link : 0},
      {"cameras", "the interface to the cameras, without the cameras",
       config.camera_interface_w * s + activity.camera_bytes * config.camera_byte_pj * kPico},
      {"static", "leakage of the FPGA", config.static_w * s},
      {"processor", "the processor that runs the device's software, with its DRAM controller",
       config.processor_w * s}};
  estimate.parts.push_back({"supply", "losses of the voltage converters",
                            estimate.joules() * (100 / config.supply_efficiency - 1)});
  return estimate;
}

const MetricTable& energy_table() {
  static const MetricTable table{
      {"energy/power_total", "W",
       "Estimate of what the device draws at its supply, without the cameras: the sum of all parts.",
       kSteadyState},
      {"energy/frame_total", "mJ",
       "Estimate of the energy of a frame, all parts; of a single frame, in the time until the host has it.",
       kSteadyState},
      {"energy/power_<part>", "W", "Estimate of the power of one part: <part>.", kSteadyState},
      {"energy/frame_<part>", "mJ", "Estimate of a frame's energy in one part: <part>.", kSteadyState},
  };
  return table;
}

void add_energy(MetricGroup& root, const EnergyEstimate& estimate, const std::string& window) {
  const MetricWriter out = MetricWriter(root, energy_table()).over(window);
  out.add("energy/power_total", estimate.watts(estimate.joules()));
  out.add("energy/frame_total", estimate.millijoules_per_frame(estimate.joules()));
  for (const EnergyEstimate::Part& part : estimate.parts) {
    const MetricWriter of_part = out.of(part.name, part.description);
    of_part.add("energy/power_<part>", estimate.watts(part.joules));
    of_part.add("energy/frame_<part>", estimate.millijoules_per_frame(part.joules));
  }
}

}  // namespace parallax
