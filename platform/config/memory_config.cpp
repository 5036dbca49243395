// SPDX-License-Identifier: Apache-2.0
#include "platform/config/memory_config.hpp"

#include "platform/config/schema.hpp"

namespace parallax {

void describe(Schema& schema, MemoryConfig& config) {
  schema.integer("memory.bytes_per_cycle", config.bytes_per_cycle, {1, 1024}, "B/cycle",
                 "Bytes that the memory bus moves in one cycle of clocks.memory_hz.",
                 inferred("DDR3, 32 bit, two transfers a cycle; 4.267 GB/s at 533 MHz"));
  schema.integer(
      "memory.latency_cycles", config.latency_cycles, {0, 100'000}, "memory cycles",
      "Cycles from a request that finds the memory idle to its first data.",
      inferred("about 120 ns through controller and interconnect, usual for a Zynq-7000-class platform"));
  schema.integer("memory.efficiency", config.efficiency, {1, 100}, "%",
                 "Share of the peak bandwidth that is left after refresh, row changes and bus turn-around.",
                 inferred("long bursts from few ports usually reach 70 to 90 % on DDR3"));
  schema.integer("memory.queue_depth", config.queue_depth, {1, 1024}, "bursts",
                 "Bursts of one port that can wait in the memory controller.", chosen("not published"));
  schema.integer("memory.size_bytes", config.size_bytes, {1ll << 20, 1ll << 40}, "B",
                 "Size of the memory; frame buffers, rectification map and output must fit.",
                 chosen("not published; a small module of the assumed memory type"));
  schema.choice(
      "memory.arbitration", config.arbitration,
      {{"round_robin", Arbitration::kRoundRobin}, {"fixed_priority", Arbitration::kFixedPriority}},
      "Which port is served when several wait: in turn, or always the first in the order camera, left, "
      "right, map, output, link.",
      chosen("not published"));
}

}  // namespace parallax
