// SPDX-License-Identifier: Apache-2.0
#include "platform/config/memory_config.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "platform/config/dram_device.hpp"
#include "platform/config/schema.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr std::int64_t picoseconds(std::uint32_t ns) { return std::int64_t{1000} * ns; }

}  // namespace

void MemoryConfig::validate() const {
  if (model == MemoryModel::kBus) return;
  dram.validate();
  if (size_bytes > dram.bytes()) {
    throw UserError(
        fmt::format("memory.size_bytes = {}: must be at most the devices' size, {} B (dram.rows * "
                    "dram.columns * dram.banks * "
                    "dram.bus_bytes)",
                    size_bytes, dram.bytes()));
  }
  if (write_high > write_queue) {
    throw UserError(fmt::format("memory.write_high = {}: must be at most memory.write_queue = {}", write_high,
                                write_queue));
  }
  if (write_low >= write_high) {
    throw UserError(
        fmt::format("memory.write_low = {}: must be below memory.write_high = {}", write_low, write_high));
  }
}

Cycles MemoryConfig::latency(const ClockDomain& clock) const {
  return Cycles(latency_cycles) + clock.cycle_at_or_after(Picoseconds(picoseconds(latency_ns)));
}

DramMemory MemoryConfig::dram_memory() const {
  DramMemory memory;
  memory.timing = dram;
  memory.policy = {read_queue, write_queue, write_high, write_low, write_batch, efficiency};
  memory.mapping = mapping;
  memory.latency =
      latency_cycles + (picoseconds(latency_ns) + dram.clock_period_ps - 1) / dram.clock_period_ps;
  memory.arbitration = arbitration;
  return memory;
}

void describe(Schema& schema, MemoryConfig& config) {
  schema.choice(
      "memory.model", config.model, {{"bus", MemoryModel::kBus}, {"dram", MemoryModel::kDram}},
      "How the memory takes its time: as a data bus with a fixed latency, or as a DRAM controller with "
      "banks, rows and refresh.",
      chosen("the simpler one; presets of machines with a DRAM say dram"));
  schema.integer(
      "memory.latency_cycles", config.latency_cycles, {0, 100'000}, "memory cycles",
      "Bus: cycles from a request that finds it idle to its first data. DRAM: clocks of the devices that "
      "ports, interconnect and PHY add to each answer.",
      inferred("about 120 ns through controller and interconnect, usual for a Zynq-7000-class platform"));
  schema.integer(
      "memory.latency_ns", config.latency_ns, {0, 1'000'000}, "ns",
      "Latency beside memory.latency_cycles that a faster memory clock does not shorten: of ports, "
      "interconnect and PHY. In whole cycles of the memory, rounded up.",
      chosen("none by default; either key says all of it"));
  schema.integer(
      "memory.efficiency", config.efficiency, {1, 100}, "%",
      "Bus: share of the peak bandwidth that is left after refresh, row changes and bus turn-around. "
      "DRAM: what a real controller reaches of what these leave.",
      inferred("bus: long bursts from few ports usually reach 70 to 90 % on DDR3"));
  schema.integer("memory.queue_depth", config.queue_depth, {1, 1024}, "bursts",
                 "Bursts of one port that can wait before the memory controller.", chosen("not published"));
  schema.integer("memory.size_bytes", config.size_bytes, {1ll << 20, 1ll << 40}, "B",
                 "Size of the memory; frame buffers, rectification map and output must fit.",
                 chosen("not published; a small module of the assumed memory type"));
  schema.choice(
      "memory.arbitration", config.arbitration,
      {{"round_robin", MemoryArbitration::kRoundRobin},
       {"fixed_priority", MemoryArbitration::kFixedPriority}},
      "Which port is served when several wait: in turn, or always the first in the order camera, left, "
      "right, map, output, link, then those of what the matcher keeps in memory.",
      chosen("not published"));

  schema.integer("memory.bytes_per_cycle", config.bytes_per_cycle, {1, 1024}, "B/cycle",
                 "Bus: bytes that it moves in one cycle of clocks.memory_hz.",
                 inferred("DDR3, 32 bit, two transfers a cycle; 4.267 GB/s at 533 MHz"));

  schema.text(
      "memory.device", config.device,
      "DRAM: the devices, a file of presets/memory by name, or a path. Its values are those of the keys "
      "dram.*, unless a preset or --set has these too.",
      inferred("DDR3-1066 of a Zynq-7000-class platform, 32 bit"));
  schema.choice(
      "memory.mapping", config.mapping,
      {{"rbc", DramMapping::kRowBankColumn},
       {"brc", DramMapping::kBankRowColumn},
       {"rbcg", DramMapping::kRowBankColumnGroup}},
      "DRAM: address bits from high to low: row, bank, column; bank, row, column; or as rbc with bursts "
      "going to the bank groups in turn.",
      chosen("not published; a stream passes through all banks"));
  const Provenance queues = chosen("not published; as the DRAM simulators that the model is compared with");
  schema.integer("memory.read_queue", config.read_queue, {1, 1024}, "bursts",
                 "DRAM: bursts of the devices that the controller's read queue holds.", queues);
  schema.integer("memory.write_queue", config.write_queue, {1, 1024}, "bursts",
                 "DRAM: bursts of the devices that the controller's write queue holds.", queues);
  schema.integer("memory.write_high", config.write_high, {1, 1024}, "bursts",
                 "DRAM: writes queued at which a batch of them begins.", queues);
  schema.integer("memory.write_low", config.write_low, {0, 1023}, "bursts",
                 "DRAM: writes queued at which the batch ends when reads wait.", queues);
  schema.integer(
      "memory.write_batch", config.write_batch, {1, 1024}, "bursts",
      "DRAM: writes of a batch that go while reads wait, after which these have their turn: without "
      "it a stream of writes as fast as the memory keeps reads waiting to its end.",
      chosen("not published; controllers bound it by such a number or by a time"));
  describe(schema, config.dram);
}

}  // namespace parallax
