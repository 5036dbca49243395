// SPDX-License-Identifier: Apache-2.0
#include "traces/fifo_trace.hpp"

namespace parallax {

FifoTrace::FifoTrace(const StreamBase& stream, PartId id, const std::shared_ptr<const RowEnds>& rows,
                     const TraceWindow& window, const TraceSinks& sinks)
    : stream_(stream), window_(window), sinks_(sinks) {
  pending_.stream = id;
  if (!rows || !window.bounded()) return;  // where it is does not matter
  writes_.emplace(rows);
  reads_.emplace(rows);
}

void FifoTrace::sample() {
  const FifoFill& last = fills_[last_];
  FifoFill& fill = fills_[1 - last_];
  stream_.fill(fill);
  if (fill.until <= last.until) return;
  const Picoseconds begin = last_date_;
  const Picoseconds end = stream_.writer_clock().date_of(fill.until);
  const std::uint64_t cycles = (fill.until - last.until).count();
  const std::uint64_t token_cycles = fill.token_cycles - last.token_cycles;
  const std::uint64_t full_cycles = fill.full_cycles - last.full_cycles;
  const std::uint64_t empty_cycles = fill.empty_cycles - last.empty_cycles;
  const std::uint64_t written = fill.written - last.written;
  const std::uint64_t freed = fill.freed - last.freed;
  const std::uint64_t level = fill.level();
  // In the window is what one of its sides does in it.
  const bool inside = !window_.bounded() || window_.contains(position(writes_), begin, end) ||
                      window_.contains(position(reads_), begin, end);
  if (writes_) writes_->advance(written);
  if (reads_) reads_->advance(freed);
  last_ = 1 - last_;
  last_date_ = end;
  // Only what may still go on is held back, one level all the time, so that the others are told in time.
  const bool still = written == 0 && freed == 0 && token_cycles == level * cycles;
  if (has_pending_ && inside && still && level == pending_.level) {
    pending_.end = end;
    pending_.cycles += cycles;
    pending_.token_cycles += token_cycles;
    pending_.full_cycles += full_cycles;
    pending_.empty_cycles += empty_cycles;
    return;
  }
  tell_pending();
  // In the member itself: to copy what has just been written field by field is a store-forwarding stall (some
  // 4 ns).
  pending_.begin = begin;
  pending_.end = end;
  pending_.cycles = cycles;
  pending_.token_cycles = token_cycles;
  pending_.full_cycles = full_cycles;
  pending_.empty_cycles = empty_cycles;
  pending_.written = written;
  pending_.freed = freed;
  pending_.level = level;
  has_pending_ = inside;
  if (!still) tell_pending();
}

void FifoTrace::tell_pending() {
  if (has_pending_) {
    for (TraceSink* sink : sinks_) sink->fifo(pending_);
  }
  has_pending_ = false;
}

void FifoTrace::finish() {
  sample();
  tell_pending();
}

}  // namespace parallax
