// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace parallax {

class Schema;

/// Which port the memory serves when several wait.
enum class Arbitration {
  kRoundRobin,     ///< in turn
  kFixedPriority,  ///< always the first in the order camera, left, right, map, output, link
};

/// The frame memory: bandwidth, latency, arbitration. Working assumption: DDR3-1066, 32 bit, 4.267 GB/s peak
/// (I).
struct MemoryConfig {
  std::uint32_t bytes_per_cycle = 8;      ///< bytes per cycle of clocks.memory_hz, 1 to 1024; I
  std::uint32_t latency_cycles = 64;      ///< memory cycles from request to first data, 0 to 100000; I
  std::uint32_t efficiency = 80;          ///< percent of the peak bandwidth that is usable, 1 to 100; I
  std::uint32_t queue_depth = 4;          ///< bursts that wait per port, 1 to 1024; own choice
  std::int64_t size_bytes = 512ll << 20;  ///< 1 MiB to 1 TiB; own choice
  Arbitration arbitration = Arbitration::kRoundRobin;  ///< own choice
};

void describe(Schema& schema, MemoryConfig& config);

}  // namespace parallax
