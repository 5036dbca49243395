// SPDX-License-Identifier: Apache-2.0
#include "platform/results/memory_metrics.hpp"

#include <algorithm>

#include "platform/results/stage_time.hpp"

namespace parallax {
namespace {

// Cycles in which a port of the core held up the stage at its other end.
void add_stalls(MetricGroup& memory, const Machine& machine, const SteadyWindow& window) {
  const double frames = static_cast<double>(std::max<std::size_t>(1, window.frames()));
  for (const MemoryPort* port : machine.ports()) {
    if (!port->stage) continue;
    memory.group(port->name)
        .add({"stalls", static_cast<double>(stage_time(*port->stage, window).memory.count()) / frames,
              "cycles", "Core cycles a frame in which this port held back the stage next to it.",
              window.text});
  }
}

void add_port(MetricGroup& group, const BusMaster& port, const SteadyWindow& window, double bytes_per_frame,
              double bytes_per_second) {
  const std::string all = "the whole run";
  group.add({"bytes_per_frame", bytes_per_frame, "B", "Bytes through the port, a frame.", window.text});
  group.add({"bandwidth", bytes_per_second / 1e6, "MB/s", "Bytes through the port by time.", window.text});
  const LatencyHistogram& latencies = port.latencies();
  const auto latency = [&](const char* name, const sc_core::sc_time& time, const char* description) {
    group.add({name, time.to_seconds() * 1e9, "ns", description, all});
  };
  latency("latency_mean", latencies.mean(), "From request to answer of a burst.");
  latency("latency_p50", latencies.percentile(0.5), "Half of the bursts are answered in this time (+1.6 %).");
  latency("latency_p95", latencies.percentile(0.95),
          "95 % of the bursts are answered in this time (+1.6 %).");
  latency("latency_p99", latencies.percentile(0.99),
          "99 % of the bursts are answered in this time (+1.6 %).");
  latency("latency_largest", latencies.largest(), "From request to answer of a burst.");
}

void add_dram(MetricGroup& memory, const DramStatistics& first, const DramStatistics& last,
              const SteadyWindow& window) {
  const auto per_frame = [&](const char* name, std::uint64_t from, std::uint64_t to, const char* unit,
                             const char* description) {
    memory.add(
        {name,
         static_cast<double>(to - from) / static_cast<double>(std::max<std::size_t>(1, window.frames())),
         unit, description, window.text});
  };
  const auto bursts = static_cast<double>(last.reads + last.writes - first.reads - first.writes);
  memory.add(
      {"row_hits",
       // A refresh may close a row before its burst has come: there may be more rows opened than bursts.
       bursts == 0
           ? 0
           : 100.0 * std::max(0.0, 1.0 - static_cast<double>(last.activates - first.activates) / bursts),
       "%", "DRAM bursts that opened no row.", window.text});
  per_frame("bursts", first.reads + first.writes, last.reads + last.writes, "bursts",
            "DRAM bursts, a frame.");
  per_frame("activates", first.activates, last.activates, "rows", "DRAM rows opened, a frame.");
  per_frame("refreshes", first.refreshes, last.refreshes, "refreshes",
            "DRAM refreshes of all banks, a frame.");
  per_frame("turn_arounds", first.turn_arounds, last.turn_arounds, "turns",
            "Changes of the DRAM's data bus between reading and writing, a frame.");
}

}  // namespace

void add_memory(MetricGroup& root, const Machine& machine, const SteadyWindow& window) {
  MetricGroup& memory = root.group("memory");
  const Memory* model = machine.memory();
  MachineSnapshot first;  // the beginning of the run
  first.ports.resize(machine.ports().size());
  if (window.frames() > 0) first = machine.snapshots()[window.first];
  const MachineSnapshot& last = machine.snapshots()[window.last];
  const double elapsed = (last.time - first.time).to_seconds();
  const auto share = [&](Cycles taken) {
    const Cycles cycles = model->cycle_at_or_after(last.time) - model->cycle_at_or_after(first.time);
    return 100.0 * (static_cast<double>(taken.count()) /
                    static_cast<double>(std::max<std::int64_t>(1, cycles.count())));
  };
  std::uint64_t total = 0;
  Cycles total_bus;  // whole cycles, so that a bus that is always taken is so for 100 %
  for (const MemoryPort* port : machine.ports()) {
    MetricGroup& group = memory.group(port->name);
    const PortSnapshot& begin = first.ports[port->number];
    const PortSnapshot& end = last.ports[port->number];
    const std::uint64_t bytes = end.bytes - begin.bytes;
    const Cycles bus = end.bus - begin.bus;
    total += bytes;
    total_bus += bus;
    // After a single frame, the next one's traffic has begun.
    const double per_frame = window.frames() == 0
                                 ? static_cast<double>(port->rows->frame())
                                 : static_cast<double>(bytes) / static_cast<double>(window.frames());
    add_port(group, *port->master, window, per_frame,
             elapsed == 0 ? 0 : static_cast<double>(bytes) / elapsed);
    if (model != nullptr) {
      group.add(
          {"share", share(bus), "%", "Time in which the memory's bus was taken for the port.", window.text});
    }
  }
  add_stalls(memory, machine, window);
  const EncodedMap& map = machine.map();
  memory.group(machine.map_port().name)
      .add({"bytes_per_pixel_and_image", map.bytes_per_pixel(), "B",
            "Compressed size of the rectification map by pixels of both images.", ""});
  memory.add({"bandwidth", elapsed == 0 ? 0 : static_cast<double>(total) / elapsed / 1e6, "MB/s",
              "Of all ports together.", window.text});
  if (model == nullptr) return;
  memory.add({"usable_bandwidth", model->usable_bandwidth() / 1e6, "MB/s", "Peak times efficiency.", ""});
  memory.add({"share", share(total_bus), "%", "Time in which the memory's bus was taken.", window.text});
  memory.add({"at_work", share(last.memory - first.memory), "%",
              "Time in which the memory was at work: its bus taken, or, in a DRAM, rows opened, the bus "
              "turned around "
              "or refreshes waited for.",
              window.text});
  if (machine.config().memory.model == MemoryModel::kDram) add_dram(memory, first.dram, last.dram, window);
}

}  // namespace parallax
