// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "tlm/bus_master.hpp"
#include "traces/row_ends.hpp"
#include "traces/trace_lane.hpp"
#include "traces/trace_window.hpp"

namespace parallax {

/// Makes rows, and on request bursts, of what passes a memory port.
class PortTrace final : public BusListener {
 public:
  /// `rows`: of the bytes, in the order in which they are asked for.
  PortTrace(BusMaster& master, PartId id, const std::shared_ptr<const RowEnds>& rows,
            const TraceWindow& window, bool bursts);

  TraceLane& rows() { return rows_; }
  TraceLane& requests() { return requests_; }
  TraceLane& bursts() { return bursts_; }
  void finish();

 private:
  // How many bursts are under way.
  class Requests final : public TraceLane {
   public:
    explicit Requests(PartId port) : port_(port) {}
    void add(Picoseconds time, std::int64_t bursts, bool inside) { changes_.push({time, bursts, inside}); }
    Picoseconds next() const override { return changes_.empty() ? kNever : changes_.date(); }
    Picoseconds tell(const TraceSinks& sinks) override;

   private:
    struct Change {
      Picoseconds time;
      std::int64_t bursts;
      bool inside;  // the window
    };
    struct ChangeDate {
      Picoseconds operator()(const Change& change) const { return change.time; }
    };
    const PartId port_;
    std::int64_t under_way_ = 0;
    DateQueue<Change, ChangeDate> changes_{ChangeDate{}};
  };

  void requested(const BusMaster& master, const sc_core::sc_time& time) override;
  void transferred(const BusMaster& master, const BusTransfer& transfer) override;
  void next_row();

  const PartId id_;
  const TraceWindow& window_;
  const bool wants_bursts_;
  RowCursor cursor_;
  PortRow row_;  // under way

  EventLane<PortRow> rows_;
  Requests requests_;
  EventLane<BurstTransfer> bursts_;
};

}  // namespace parallax
