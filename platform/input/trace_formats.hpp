// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tlm/dram_replay.hpp"

namespace parallax {

/// How a file of requests is written. A new format is one row of the table.
struct TraceFormat {
  std::string name;
  std::string form;             ///< of a line, for messages
  bool has_cycles = false;      ///< time_ns is a cycle as it stands in the file
  bool has_bytes = false;       ///< each request says how long it is
  bool may_have_bytes = false;  ///< some may
  /// Whether the first line that is neither empty nor a comment is one of this format.
  bool (*is)(const std::string& line);
  /// Reads a line; returns what is wrong with it, or nothing. What the format does not say stays as it is.
  std::string (*read)(const std::string& line, TraceRequest& request);
};

/// The first line of the project's own format; blanks in it do not matter.
inline constexpr const char* kTraceHeader = "time_ns,rw,addr,bytes";
bool is_trace_header(const std::string& line);

/// The format of a trace that begins with this line. Throws UserError, without the name of the file, when it
/// is none.
const TraceFormat& trace_format_of(const std::string& line);

}  // namespace parallax
