// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "tlm/clock_domain.hpp"
#include "tlm/dram_address.hpp"
#include "tlm/dram_scheduler.hpp"
#include "tlm/dram_timing.hpp"
#include "tlm/memory_queues.hpp"
#include "tlm/units.hpp"

namespace parallax {

class Schema;

enum class MemoryModel {
  kBus,   ///< a data bus with a latency
  kDram,  ///< a DRAM controller with its devices
};

/// The frame memory. Working assumption for the paper's machine: DDR3-1066, 32 bit, 4.267 GB/s peak (I).
struct MemoryConfig {
  MemoryModel model = MemoryModel::kBus;

  std::uint32_t latency_cycles = 64;  ///< memory cycles, 0 to 100000: of the bus, to the first data; of a
                                      ///< DRAM, what ports and interconnect add; I
  std::uint32_t latency_ns = 0;       ///< 0 to 10^6, beside these: whatever the memory's clock is; own choice
  std::uint32_t efficiency = 80;      ///< percent of the peak bandwidth that is usable, 1 to 100; I
  std::uint32_t queue_depth = 4;      ///< bursts that wait per port, 1 to 1024; own choice
  std::int64_t size_bytes = 512ll << 20;                           ///< 1 MiB to 1 TiB; own choice
  MemoryArbitration arbitration = MemoryArbitration::kRoundRobin;  ///< own choice

  std::uint32_t bytes_per_cycle = 8;  ///< bus: bytes per cycle of clocks.memory_hz, 1 to 1024; I

  std::string device = "ddr3-1066-x32";               ///< DRAM: where `dram` comes from
  DramTiming dram;                                    ///< DRAM: the rank of devices
  DramMapping mapping = DramMapping::kRowBankColumn;  ///< DRAM; own choice
  std::uint32_t read_queue = 32;                      ///< DRAM: bursts, 1 to 1024; own choice
  std::uint32_t write_queue = 32;                     ///< DRAM: bursts, 1 to 1024; own choice
  std::uint32_t write_high =
      26;                       ///< DRAM: writes queued at which a batch begins, 1 to write_queue; own choice
  std::uint32_t write_low = 6;  ///< DRAM: writes queued at which it ends, below write_high; own choice
  std::uint32_t write_batch = 64;  ///< DRAM: writes, 1 to 1024, that may go while reads wait; own choice

  /// Throws UserError when values are fine alone but not together.
  void validate() const;
  /// latency_cycles and latency_ns together, in cycles of `clock`; what is no whole cycle takes one more.
  Cycles latency(const ClockDomain& clock) const;
  /// For a DRAM.
  DramMemory dram_memory() const;
};

void describe(Schema& schema, MemoryConfig& config);

}  // namespace parallax
