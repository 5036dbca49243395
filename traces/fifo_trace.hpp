// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "tlm/stream_base.hpp"
#include "traces/row_ends.hpp"
#include "traces/trace_sink.hpp"
#include "traces/trace_window.hpp"

namespace parallax {

/// Tells sinks how full a FIFO is, in spans from one time it is asked to another.
class FifoTrace final {
 public:
  /// `rows`: of the tokens; none when they belong to no row.
  FifoTrace(const StreamBase& stream, PartId id, const std::shared_ptr<const RowEnds>& rows,
            const TraceWindow& window, const TraceSinks& sinks);

  /// Looks how full the FIFO is; what has not changed since becomes one span.
  void sample();
  void finish();

 private:
  TracePosition position(const std::optional<RowCursor>& rows) const {
    return rows ? rows->position() : TracePosition{};
  }
  void tell_pending();

  const StreamBase& stream_;
  const TraceWindow& window_;
  const TraceSinks& sinks_;
  FifoFill fills_[2];  // that a span has been made until, and its date, and the one at hand
  std::size_t last_ = 0;
  Picoseconds last_date_;
  FifoSpan pending_;  // while it goes on alike
  bool has_pending_ = false;
  std::optional<RowCursor> writes_, reads_;
};

}  // namespace parallax
