// SPDX-License-Identifier: Apache-2.0
#include "traces/port_trace.hpp"

#include <algorithm>

namespace parallax {
namespace {

Picoseconds date(const sc_core::sc_time& time) { return Picoseconds(time.value()); }

}  // namespace

PortTrace::PortTrace(BusMaster& master, PartId id, const std::shared_ptr<const RowEnds>& rows,
                     const TraceWindow& window, bool bursts, const TraceSinks& sinks)
    : id_(id), window_(window), wants_bursts_(bursts), cursor_(rows), sinks_(sinks) {
  row_.port = id;
  row_.position = cursor_.position();
  master.add_listener(*this);
}

void PortTrace::known_until(Picoseconds until) {
  while (!changes_.empty() && changes_.date() < until) {
    const Picoseconds now = changes_.date();
    bool inside = false;
    for (; !changes_.empty() && changes_.date() == now; changes_.pop()) {
      under_way_ += changes_.front().bursts;
      inside |= changes_.front().inside;
    }
    if (!inside) continue;
    for (TraceSink* sink : sinks_) sink->requests({id_, now, under_way_});
  }
}

void PortTrace::requested(const BusMaster&, const sc_core::sc_time& time) {
  if (!wants_bursts_) return;
  changes_.push({date(time), 1, window_.contains(cursor_.position(), date(time), date(time))});
}

void PortTrace::transferred(const BusMaster&, const BusTransfer& transfer) {
  const Picoseconds requested = date(transfer.requested);
  const Picoseconds answered = date(transfer.answered);
  if (wants_bursts_) {
    const BurstTransfer burst{
        id_, cursor_.position(), transfer.write, transfer.address, transfer.bytes, requested, answered};
    if (window_.contains(burst.position, requested, answered)) {
      for (TraceSink* sink : sinks_) sink->burst(burst);
    }
    changes_.push({answered, -1, window_.contains(burst.position, answered, answered)});
  }
  // A burst counts for the row in which it begins; its bytes for the rows that they belong to.
  if (row_.bursts == 0) row_.begin = std::max(row_.begin, requested);
  ++row_.bursts;
  row_.latency += answered - requested;
  row_.longest_latency = std::max(row_.longest_latency, answered - requested);
  row_.end = std::max(row_.end, answered);
  std::uint64_t left = transfer.bytes;
  for (; left >= cursor_.left_in_row(); next_row()) {
    const std::uint64_t bytes = cursor_.left_in_row();
    row_.bytes += bytes;
    left -= bytes;
    cursor_.advance(bytes);
  }
  row_.bytes += left;
  cursor_.advance(left);
}

// The row is complete.
void PortTrace::next_row() {
  tell_row();
  const Picoseconds end = row_.end;
  row_ = {};
  row_.port = id_;
  row_.position = cursor_.position();
  row_.begin = row_.end = end;
}

void PortTrace::tell_row() {
  if (!window_.contains(row_.position, row_.begin, row_.end)) return;
  for (TraceSink* sink : sinks_) sink->port_row(row_);
}

void PortTrace::finish() {
  if (row_.bursts > 0) tell_row();
}

}  // namespace parallax
