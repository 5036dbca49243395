// SPDX-License-Identifier: Apache-2.0
#include "platform/results/memory_metrics.hpp"

#include <algorithm>

#include "platform/results/stage_time.hpp"

namespace parallax {
namespace {

// Cycles in which a port of the core held up the stage at its other end.
void add_stalls(const MetricWriter& out, const Machine& machine, const SteadyWindow& window) {
  for (const MemoryPort* port : machine.ports()) {
    if (!port->stage) continue;
    out.of(port->name)
        .add("memory/<port>/stalls", stage_time(*port->stage, window).memory.real() / window.divisor());
  }
}

void add_port(const MetricWriter& out, const BusMaster& port, double bytes_per_frame,
              double bytes_per_second) {
  out.add("memory/<port>/bytes_per_frame", bytes_per_frame);
  out.add("memory/<port>/bandwidth", bytes_per_second / 1e6);
  const LatencyHistogram& latencies = port.latencies();
  const MetricWriter all = out.over(kWholeRun);
  const auto latency = [&](const char* path, const sc_core::sc_time& time) {
    all.add(path, time.to_seconds() * 1e9);
  };
  latency("memory/<port>/latency_mean", latencies.mean());
  latency("memory/<port>/latency_p50", latencies.percentile(0.5));
  latency("memory/<port>/latency_p95", latencies.percentile(0.95));
  latency("memory/<port>/latency_p99", latencies.percentile(0.99));
  latency("memory/<port>/latency_largest", latencies.largest());
}

void add_dram(const MetricWriter& out, const DramStatistics& first, const DramStatistics& last,
              const SteadyWindow& window) {
  const auto per_frame = [&](const char* path, std::uint64_t from, std::uint64_t to) {
    out.add(path, quotient(to - from, window.divisor()));
  };
  const std::uint64_t bursts = last.reads + last.writes - first.reads - first.writes;
  out.add("memory/row_hits",
          // A refresh may close a row before its burst has come: there may be more rows opened than bursts.
          bursts == 0 ? 0 : 100.0 * std::max(0.0, 1.0 - quotient(last.activates - first.activates, bursts)));
  per_frame("memory/bursts", first.reads + first.writes, last.reads + last.writes);
  per_frame("memory/activates", first.activates, last.activates);
  per_frame("memory/refreshes", first.refreshes, last.refreshes);
  per_frame("memory/turn_arounds", first.turn_arounds, last.turn_arounds);
}

}  // namespace

const MetricTable& memory_table() {
  static const MetricTable table{
      {"memory/bandwidth", "MB/s", "Bytes that all ports move, a second (1 MB is 10^6 B).", kSteadyState},
      {"memory/usable_bandwidth", "MB/s",
       "Peak bandwidth of the devices (or memory.bytes_per_cycle times clocks.memory_hz) times "
       "memory.efficiency.",
       ""},
      {"memory/share", "%", "Share of the time in which the memory's bus was taken.", kSteadyState},
      {"memory/at_work", "%",
       "Share of the time in which the memory had something to do: its bus taken, or, in a DRAM, rows "
       "opened, the "
       "bus turned around, or a refresh waited for.",
       kSteadyState},
      {"memory/row_hits", "%", "DRAM bursts (32 B on a 32-bit bus) that opened no row.", kSteadyState},
      {"memory/bursts", "bursts", "DRAM bursts, a frame.", kSteadyState},
      {"memory/activates", "rows", "DRAM rows opened, a frame.", kSteadyState},
      {"memory/refreshes", "refreshes", "DRAM refreshes of all banks, a frame.", kSteadyState},
      {"memory/turn_arounds", "turns", "Changes of the DRAM's data bus between reading and writing, a frame.",
       kSteadyState},
      {"memory/<port>/bytes_per_frame", "B", "Bytes through this port, a frame.", kSteadyState},
      {"memory/<port>/bandwidth", "MB/s", "Bytes through this port, a second.", kSteadyState},
      {"memory/<port>/share", "%", "Share of the time in which the memory's bus was taken for this port.",
       kSteadyState},
      {"memory/<port>/latency_mean", "ns", "Mean time from a burst's request to its answer.", kWholeRun},
      {"memory/<port>/latency_p50", "ns",
       "Half of the bursts were answered in this time (up to 1.6 % too large).", kWholeRun},
      {"memory/<port>/latency_p95", "ns",
       "95 % of the bursts were answered in this time (up to 1.6 % too large).", kWholeRun},
      {"memory/<port>/latency_p99", "ns",
       "99 % of the bursts were answered in this time (up to 1.6 % too large).", kWholeRun},
      {"memory/<port>/latency_largest", "ns", "Time from request to answer of the slowest burst.", kWholeRun},
      {"memory/<port>/stalls", "cycles",
       "Core cycles a frame in which this port held back the stage next to it.", kSteadyState},
      {"memory/map/bytes_per_pixel_and_image", "B",
       "Size of the compressed rectification map by the pixels of both images.", ""},
  };
  return table;
}

void add_memory(MetricGroup& root, const Machine& machine, const SteadyWindow& window) {
  const MetricWriter out = MetricWriter(root, memory_table()).over(window.text);
  const Memory* model = machine.memory();
  MachineSnapshot first;  // the beginning of the run
  first.ports.resize(machine.ports().size());
  if (window.frames() > 0) first = machine.snapshots()[window.first];
  const MachineSnapshot& last = machine.snapshots()[window.last];
  const double elapsed = (last.time - first.time).to_seconds();
  const auto share = [&](Cycles taken) {
    const Cycles cycles = model->cycle_at_or_after(last.time) - model->cycle_at_or_after(first.time);
    return 100.0 * quotient(taken.count(), std::max<std::int64_t>(1, cycles.count()));
  };
  std::uint64_t total = 0;
  Cycles total_bus;  // whole cycles, so that a bus that is always taken is so for 100 %
  for (const MemoryPort* port : machine.ports()) {
    const MetricWriter of_port = out.of(port->name);
    const PortSnapshot& begin = first.ports[port->number];
    const PortSnapshot& end = last.ports[port->number];
    const std::uint64_t bytes = end.bytes - begin.bytes;
    const Cycles bus = end.bus - begin.bus;
    total += bytes;
    total_bus += bus;
    // After a single frame, the next one's traffic has begun.
    const double per_frame = quotient(window.frames() == 0 ? port->rows->frame() : bytes, window.divisor());
    add_port(of_port, *port->master, per_frame, quotient(bytes, elapsed));
    if (model != nullptr) of_port.add("memory/<port>/share", share(bus));
  }
  add_stalls(out, machine, window);
  out.add("memory/map/bytes_per_pixel_and_image", machine.map().bytes_per_pixel());
  out.add("memory/bandwidth", quotient(total, elapsed) / 1e6);
  if (model == nullptr) return;
  out.add("memory/usable_bandwidth", model->usable_bandwidth() / 1e6);
  out.add("memory/share", share(total_bus));
  out.add("memory/at_work", share(last.memory - first.memory));
  if (machine.config().memory.model == MemoryModel::kDram) add_dram(out, first.dram, last.dram, window);
}

}  // namespace parallax
