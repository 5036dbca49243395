// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "tlm/stream_base.hpp"
#include "traces/row_ends.hpp"
#include "traces/trace_lane.hpp"
#include "traces/trace_window.hpp"

namespace parallax {

/// Makes spans of how full a FIFO is, each time it is asked.
class FifoTrace final {
 public:
  /// `rows`: of the tokens; none when they belong to no row.
  FifoTrace(const StreamBase& stream, PartId id, const std::shared_ptr<const RowEnds>& rows,
            const TraceWindow& window);

  TraceLane& spans() { return spans_; }
  /// Looks how full the FIFO is; what has not changed since becomes one span.
  void sample();
  void finish();

 private:
  TracePlace place(const std::optional<RowCursor>& rows) const { return rows ? rows->place() : TracePlace{}; }
  void push_pending();

  const StreamBase& stream_;
  const PartId id_;
  const TraceWindow& window_;
  FifoFill last_;  // that a span has been made until, and its date
  Picoseconds last_date_;
  FifoSpan pending_;  // while it goes on alike
  bool has_pending_ = false;
  std::optional<RowCursor> writes_, reads_;

  EventLane<FifoSpan> spans_;
};

}  // namespace parallax
