// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tlm/dram_replay.hpp"

namespace parallax {

/// What a trace of another program leaves open.
struct TraceReading {
  double cycle_ns = 1;                 ///< of the devices, for what counts cycles
  std::optional<double> mhz;           ///< of the clock that the trace counts; none: that of the devices
  std::optional<std::uint64_t> bytes;  ///< of a request that says nothing of it; none: 64
};

/// Reads an address trace, plain or gzip, in any of the formats of trace_formats.hpp, which its first line
/// shows. Times ascend. What begins with # is a comment; empty lines, a byte order mark and blanks do not
/// matter. `notice` hears how a trace of another program is taken. Throws UserError with file and line.
std::vector<TraceRequest> read_address_trace(const std::string& path, const TraceReading& reading = {},
                                             const std::function<void(const std::string&)>& notice = {});

}  // namespace parallax
