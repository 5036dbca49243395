// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "tlm/stage.hpp"
#include "traces/stage_rows.hpp"
#include "traces/trace_sink.hpp"
#include "traces/trace_window.hpp"

namespace parallax {

/// Tells sinks the rows, and on request the firings, that a stage's firings make. Leaps are taken as they
/// come: only where a row begins within one are firings gone through one by one, unless all are wanted.
class StageTrace final : public StageListener {
 public:
  /// Number of a stream.
  using StreamId = std::function<PartId(const StreamBase* stream)>;

  StageTrace(Stage& stage, PartId id, const StagePorts& ports, const TraceWindow& window, bool firings,
             StreamId stream_id, const TraceSinks& sinks);

  /// The stage has gone as far as it goes: its last row ends here.
  void finish();

 private:
  struct Wait {  // in the row that is under way
    StageActivity activity;
    const StreamBase* stream;
    Cycles cycles;
  };

  void fired(const Stage&, const FiringDates& firing) override {
    note(firing);
    wait_for_row();
  }
  void repeated(const Stage& stage, const std::vector<FiringDates>& period, Cycles later, Cycles every,
                std::uint64_t times) override;

  // Where the time of one period goes.
  struct Period {
    const FiringDates* first = nullptr;
    Cycles begin;
    StageStatistics time;
    std::vector<Wait> waits;
    std::int64_t times = 0;  // that the row does not count yet
  };

  void note(const FiringDates& firing);
  void note_firing(const FiringDates& firing);
  static void add_wait(const Wait& wait, std::vector<Wait>& waits);
  static void add_waits(const FiringDates& firing, StageStatistics& time, std::vector<Wait>& waits);
  void add_periods(const std::vector<FiringDates>& period, std::uint64_t times);
  void count_periods();
  void begin_row(Cycles start);
  void end_row(const FiringDates& next);
  std::uint64_t until_next_row() const { return row_end_ - firing_; }
  void wait_for_row() { set_patience(in_row_ && !wants_firings_ ? until_next_row() : 0); }
  PartId id_of(const StreamBase* stream);
  const ScheduleRow& schedule_row() const { return schedule_.rows[row_]; }
  Picoseconds date(Cycles cycle) const { return clock_.date_of(cycle); }

  const PartId id_;
  const ClockDomain& clock_;
  const ScheduleRows schedule_;
  const std::int64_t passes_;
  const std::int32_t rows_of_a_tile_;
  const TraceWindow& window_;
  const bool wants_firings_;
  const StreamId stream_id_;
  std::vector<std::pair<const StreamBase*, PartId>> stream_ids_;  // of those asked for: a handful

  std::uint64_t firing_ = 0;   // of the pass, the next one
  std::size_t row_ = 0;        // of the pass, that it belongs to
  std::uint64_t row_end_ = 0;  // the first firing after it
  std::int64_t pass_ = 0;
  bool in_row_ = false;
  bool in_window_ = false;  // the row, by where or when it begins
  StageRow current_;
  std::vector<Wait> waits_;
  Period period_;   // the last one: a leap brings the same again and again
  Cycles free_{0};  // after the last firing

  const TraceSinks& sinks_;
};

}  // namespace parallax
