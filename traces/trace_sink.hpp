// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "traces/trace_event.hpp"

namespace parallax {

/// Takes the bytes of a file, piece by piece.
using ByteSink = std::function<void(std::string_view)>;

/// Takes a trace event by event, in the order of their dates: that of a span's end, of a firing's start, of a
/// token's cycle, of an answer. What is told besides (row_begins, requests) is told at its date. Only spans
/// of FIFOs may come late: how full one was is certain when its reader has gone on.
///
/// A recorder tells each part's events as they become known, parts ahead of each other: DateOrder stands
/// between it and a sink.
class TraceSink {
 public:
  virtual ~TraceSink() = default;

  virtual void begin(const TraceParts& /*parts*/) {}
  virtual void row_begins(const RowBegin& /*row*/) {}
  virtual void row(const StageRow& /*row*/) {}
  virtual void fifo(const FifoSpan& /*span*/) {}
  virtual void port_row(const PortRow& /*row*/) {}
  virtual void frame_step(std::int64_t /*frame*/, FrameStep /*step*/, Picoseconds /*time*/) {}
  /// A frame is at the host.
  virtual void frame(const FrameRecord& /*record*/) {}
  // Only of a trace of tokens:
  virtual void firing(const StageFiring& /*firing*/) {}
  virtual void token(const TokenTransfer& /*token*/) {}
  virtual void requests(const PortRequests& /*requests*/) {}
  virtual void burst(const BurstTransfer& /*burst*/) {}
  /// What there is to tell of before `date` has been told.
  virtual void known_until(Picoseconds /*date*/) {}
  /// Nothing more happens. `waits`: of a machine that is stuck.
  virtual void end(Picoseconds /*time*/, const std::vector<EndlessWait>& /*waits*/) {}
};

/// Sinks that are all told the same.
using TraceSinks = std::vector<TraceSink*>;

}  // namespace parallax
