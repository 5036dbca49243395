// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "tlm/bus_master.hpp"
#include "traces/date_queue.hpp"
#include "traces/row_ends.hpp"
#include "traces/trace_sink.hpp"
#include "traces/trace_window.hpp"

namespace parallax {

/// Tells sinks the rows, and on request the bursts, of what passes a memory port.
class PortTrace final : public BusListener {
 public:
  /// `rows`: of the bytes, in the order in which they are asked for.
  PortTrace(BusMaster& master, PartId id, const std::shared_ptr<const RowEnds>& rows,
            const TraceWindow& window, bool bursts, const TraceSinks& sinks);

  /// Tells how many bursts were under way, until that date.
  void known_until(Picoseconds date);
  void finish();

 private:
  struct Change {  // of how many bursts are under way
    Picoseconds time;
    std::int64_t bursts;
    bool inside;  // the window
  };
  struct ChangeDate {
    Picoseconds operator()(const Change& change) const { return change.time; }
  };

  void requested(const BusMaster& master, const sc_core::sc_time& time) override;
  void transferred(const BusMaster& master, const BusTransfer& transfer) override;
  void next_row();
  void tell_row();

  const PartId id_;
  const TraceWindow& window_;
  const bool wants_bursts_;
  RowCursor cursor_;
  PortRow row_;                 // under way
  std::int64_t under_way_ = 0;  // bursts, until what is left of
  DateQueue<Change, ChangeDate> changes_{ChangeDate{}};

  const TraceSinks& sinks_;
};

}  // namespace parallax
