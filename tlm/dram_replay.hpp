// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tlm/dram_controller.hpp"

namespace parallax {

/// One line of an address trace.
struct TraceRequest {
  double time_ns = 0;  ///< not before this
  bool write = false;
  std::uint64_t address = 0;
  std::uint64_t bytes = 64;
};

struct ReplayResult {
  std::uint64_t reads = 0;       ///< of 64 bytes or the part of one
  std::uint64_t writes = 0;      ///< likewise
  std::uint64_t bytes = 0;       ///< on the data bus: whole bursts
  std::int64_t first_clock = 0;  ///< at which the first request may enter
  std::int64_t clocks = 0;       ///< until the last data beat is over
  double latency_sum = 0;        ///< ns, of all reads
  double latency_largest = 0;
  bool saturating =
      false;  ///< all requests may come at once: latencies count from acceptance, else from time_ns
  DramStatistics commands;
};

/// Replays a trace against the controller alone: requests enter in the order of the trace, each no earlier
/// than its time, one burst a clock at most; a read while fewer than `window` reads are under way, a write
/// when the write queue has room; one that cannot enter holds up all after it. Requests are cut at multiples
/// of 64 bytes, these parts into bursts.
ReplayResult replay(const std::vector<TraceRequest>& trace, const DramTiming& timing,
                    const DramPolicy& policy, DramMapping mapping, std::size_t window);

}  // namespace parallax
