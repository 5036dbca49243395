// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "tlm/stream_base.hpp"
#include "traces/row_ends.hpp"
#include "traces/trace_lane.hpp"
#include "traces/trace_window.hpp"

namespace parallax {

/// Makes spans of how full a FIFO is, each time it is asked, and on request an event of every token.
class FifoTrace final : public StreamListener {
 public:
  /// `rows`: of the tokens; none when they belong to no row.
  FifoTrace(StreamBase& stream, PartId id, const std::shared_ptr<const RowEnds>& rows, const TraceWindow& window,
            bool tokens);

  TraceLane& spans() { return spans_; }
  TraceLane& written() { return written_; }
  TraceLane& read() { return read_; }
  /// Looks how full the FIFO is; what has not changed since becomes one span.
  void sample();
  void finish();

 private:
  /// What has passed one side, for what is asked and for what is told token by token.
  struct Side {
    std::optional<RowCursor> rows;
    TracePlace place() const { return rows ? rows->place() : TracePlace{}; }
    void advance(std::uint64_t tokens) {
      if (rows) rows->advance(tokens);
    }
  };

  void written(const StreamBase& stream, Cycles cycle) override;
  void read(const StreamBase& stream, Cycles cycle) override;
  void push(EventLane<TokenTransfer>& lane, Side& side, bool is_read, const ClockDomain& clock, Cycles cycle);
  void push_pending();

  StreamBase& stream_;
  const PartId id_;
  const TraceWindow& window_;
  FifoFill last_;      // that a span has been made until
  FifoSpan pending_;   // while it goes on alike
  bool has_pending_ = false;
  Side sampled_writes_, sampled_reads_, token_writes_, token_reads_;

  EventLane<FifoSpan> spans_;
  EventLane<TokenTransfer> written_;
  EventLane<TokenTransfer> read_;
};

}  // namespace parallax
