// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace parallax {

/// What of a run is to be traced, as the user says it.
struct TraceOptions {
  std::string formats;  ///< "perfetto,vcd,csv,json"; empty: no trace
  std::string level;    ///< "rows" or "tokens"; empty: rows
  std::string from;     ///< a frame, a row or a date (read_trace_bound); empty: the beginning
  std::string to;       ///< likewise; empty: the end
  std::string parts;    ///< stages and memory ports, separated by commas; empty: all

  bool wanted() const { return !formats.empty(); }
};

}  // namespace parallax
