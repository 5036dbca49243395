// SPDX-License-Identifier: Apache-2.0
#include "traces/token_trace.hpp"

#include <algorithm>

namespace parallax {

TokenTrace::Side::Side(const ClockDomain& clock, const std::shared_ptr<const RowEnds>& rows,
                       const TraceWindow& window, std::uint32_t depth)
    : clock_(clock) {
  if (rows) rows_.emplace(rows);
  // While the one side is in the window, the other is at most as many tokens away as the FIFO holds.
  if (window.from && window.from->time) {
    first_cycle_ = clock.cycle_at_or_after(*window.from->time) - Cycles(1);
  } else if (window.from && rows) {
    const std::uint64_t first = rows->first_of(window.from->frame, window.from->row.value_or(0));
    first_token_ = first - std::min<std::uint64_t>(first, depth);
  }
  if (window.to && window.to->time) {
    end_cycle_ = clock.cycle_at_or_after(*window.to->time);
  } else if (window.to && rows) {
    end_token_ =
        rows->end_of(window.to->frame, window.to->row.value_or(rows->rows_of_a_tile - 1)) + depth + 1;
  }
  if (!rows && ((window.from && !window.from->time) || (window.to && !window.to->time))) end_token_ = 0;
}

void TokenTrace::Side::count(std::uint64_t tokens) {
  passed_ += tokens;
  taken_ += tokens;
  if (rows_) rows_->advance(tokens);
}

void TokenTrace::Side::pass(Cycles cycle) {
  if (passed_ >= end_token_ || cycle >= end_cycle_) return;
  if (passed_ < first_token_ || cycle < first_cycle_) return count(1);
  Token token;
  token.begin = cycle == last_cycle_ + Cycles(1) ? last_end_ : clock_.date_of(cycle);
  token.end = last_end_ = clock_.date_of(cycle + Cycles(1));
  last_cycle_ = cycle;
  if (rows_) {
    token.position = rows_->position();
    rows_->advance(1);
  }
  ++passed_;
  tokens_.push(token);
}

void TokenTrace::Side::pass_again(const std::vector<Cycles>& period, Cycles every, std::uint64_t times) {
  const std::uint64_t size = period.size();
  for (Cycles later = every; times > 0;) {
    if (passed_ >= end_token_ || period.front() + later >= end_cycle_) return;
    std::uint64_t before = passed_ < first_token_ ? (first_token_ - passed_) / size : 0;
    if (const Cycles last = period.back() + later; last < first_cycle_) {
      const std::int64_t more = ((first_cycle_ - last).count() - 1) / every.count();
      before = std::max(before, static_cast<std::uint64_t>(more) + 1);
    }
    before = std::min(before, times);
    if (before > 0) {
      count(before * size);
      later += every * before;
      times -= before;
      continue;
    }
    for (const Cycles cycle : period) pass(cycle + later);
    later += every;
    --times;
  }
}

TokenTrace::TokenTrace(StreamBase& stream, PartId id, const std::shared_ptr<const RowEnds>& rows,
                       const TraceWindow& window, const TraceSinks& sinks)
    : id_(id),
      window_(window),
      sinks_(sinks),
      writes_(stream.writer_clock(), rows, window, stream.depth()),
      reads_(stream.reader_clock(), rows, window, stream.depth()) {
  stream.add_listener(*this);
}

void TokenTrace::known_until(Picoseconds until) {
  for (;;) {
    const Picoseconds date = std::min(writes_.next(), reads_.next());
    if (date >= until) return;
    // The level is that after the cycle, for both.
    const bool written = writes_.take(date);
    const bool read = reads_.take(date);
    if (written) {
      notify(writes_.front(), false);
      writes_.pop();
    }
    if (read) {
      notify(reads_.front(), true);
      reads_.pop();
    }
  }
}

void TokenTrace::notify(const Token& token, bool is_read) const {
  if (!window_.contains(token.position, token.begin, token.end)) return;
  const TokenTransfer transfer{id_,         is_read,   token.position,
                               token.begin, token.end, writes_.taken() - reads_.taken()};
  for (TraceSink* sink : sinks_) sink->token(transfer);
}

}  // namespace parallax
