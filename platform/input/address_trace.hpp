// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tlm/dram_replay.hpp"

namespace parallax {

/// Reads an address trace, plain or gzip: a line "time_ns,rw,addr,bytes", then one line a request with a time
/// in ns
/// (>= 0), R or W, an address (decimal, or hexadecimal with 0x) and 1 to 2^20 bytes. Throws UserError with
/// file and line.
std::vector<TraceRequest> read_address_trace(const std::string& path);

}  // namespace parallax
