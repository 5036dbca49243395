// SPDX-License-Identifier: Apache-2.0
#include "traces/fifo_trace.hpp"

namespace parallax {
namespace {

// Whether a span holds one level all the time.
bool is_still(const FifoSpan& span) {
  return span.written == 0 && span.freed == 0 && span.token_cycles == span.level * span.cycles;
}

}  // namespace

FifoTrace::FifoTrace(const StreamBase& stream, PartId id, const std::shared_ptr<const RowEnds>& rows,
                     const TraceWindow& window)
    : stream_(stream),
      id_(id),
      window_(window),
      spans_([](const FifoSpan& span) { return span.end; },
             [](const FifoSpan& span, TraceSink& sink) { sink.fifo(span); }) {
  if (!rows || !window.bounded()) return;  // where it is does not matter
  writes_.emplace(rows);
  reads_.emplace(rows);
}

void FifoTrace::sample() {
  const FifoFill fill = stream_.fill();
  if (fill.until <= last_.until) return;
  const ClockDomain& clock = stream_.writer_clock();
  FifoSpan span;
  span.stream = id_;
  span.begin = last_date_;
  span.end = last_date_ = clock.date_of(fill.until);
  span.cycles = static_cast<std::uint64_t>((fill.until - last_.until).count());
  span.token_cycles = fill.token_cycles - last_.token_cycles;
  span.full_cycles = fill.full_cycles - last_.full_cycles;
  span.empty_cycles = fill.empty_cycles - last_.empty_cycles;
  span.written = fill.written - last_.written;
  span.freed = fill.freed - last_.freed;
  span.level = fill.level();
  // In the window is what one of its sides does in it.
  const bool inside = !window_.bounded() || window_.contains(place(writes_), span.begin, span.end) ||
                      window_.contains(place(reads_), span.begin, span.end);
  if (writes_) writes_->advance(span.written);
  if (reads_) reads_->advance(span.freed);
  last_ = fill;
  if (has_pending_ && inside && is_still(span) && is_still(pending_) && span.level == pending_.level) {
    pending_.end = span.end;
    pending_.cycles += span.cycles;
    pending_.token_cycles += span.token_cycles;
    pending_.full_cycles += span.full_cycles;
    pending_.empty_cycles += span.empty_cycles;
    return;
  }
  push_pending();
  pending_ = span;
  has_pending_ = inside;
  // Only what may still go on is held back, so that the others are told in time.
  if (!is_still(pending_)) push_pending();
}

void FifoTrace::push_pending() {
  if (has_pending_) spans_.push(pending_);
  has_pending_ = false;
}

void FifoTrace::finish() {
  sample();
  push_pending();
}

}  // namespace parallax
