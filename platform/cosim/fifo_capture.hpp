// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "platform/cosim/fifo_signals.hpp"

namespace parallax {

/// One side of a FIFO, at the rising edges of its clock: what was there just before each. Cycle 0 is the
/// first edge at which reset is over.
struct FifoSide {
  std::vector<std::int64_t> edges;  ///< their dates, in any unit, one for both sides
  std::vector<bool> granted;        ///< by the FIFO: it takes a token (write side), or has one (read side)
  std::vector<bool> wanted;         ///< by who is connected to it: both together move a token
};

/// What a simulation wrote down of a FIFO.
struct FifoCapture {
  std::string file;
  bool two_clocks = false;  ///< else the edges of both sides are the same
  FifoSide write, read;
};

/// By its content a VCD, or a CSV with one row for each cycle of one clock, whose first line names the
/// columns. Plain or gzip. Throws UserError: damaged, a signal or column that is missing or unknown (x), no
/// edge after reset, reset for a second time.
FifoCapture read_fifo_capture(const std::string& path, const FifoSignals& signals);

}  // namespace parallax
