// SPDX-License-Identifier: Apache-2.0
#include "traces/stage_trace.hpp"

#include <algorithm>
#include <utility>

namespace parallax {
namespace {

std::int32_t rows_of_a_tile(const StagePorts& ports) {
  if (ports.read) return ports.read->rows->rows_of_a_tile;
  return ports.written ? ports.written->rows->rows_of_a_tile : 1;
}

}  // namespace

StageTrace::StageTrace(Stage& stage, PartId id, const StagePorts& ports, const TraceWindow& window,
                       bool firings, StreamId stream_id, const TraceSinks& sinks)
    : id_(id),
      clock_(stage.clock()),
      schedule_(rows_of(stage.schedule(), ports)),
      passes_(ports.passes),
      rows_of_a_tile_(rows_of_a_tile(ports)),
      window_(window),
      wants_firings_(firings),
      stream_id_(std::move(stream_id)),
      sinks_(sinks) {
  current_.stage = id;
  stage.add_listener(*this);
}

PartId StageTrace::id_of(const StreamBase* stream) {
  for (const auto& [known, id] : stream_ids_) {
    if (known == stream) return id;
  }
  stream_ids_.emplace_back(stream, stream_id_(stream));
  return stream_ids_.back().second;
}

void StageTrace::repeated(const Stage&, const std::vector<FiringDates>& period, Cycles later, Cycles every,
                          std::uint64_t times) {
  if (in_row_ && !wants_firings_ && times * period.size() < until_next_row()) {
    add_periods(period, times);
    firing_ += times * period.size();
    free_ = period.back().start + Cycles(period.back().interval) + later + every * (times - 1);
    wait_for_row();
    return;
  }
  while (times > 0) {
    // Whole periods before the firing with which the next row begins.
    const std::uint64_t left = until_next_row();
    const std::uint64_t possible = times * period.size() <= left ? times : left / period.size();
    const std::uint64_t periods = in_row_ ? possible : 0;
    const Cycles until = later + every * periods;
    const bool one_by_one =
        wants_firings_ && window_.contains(current_.position, date(period.front().free + later),
                                           date(period.back().start + until));
    const std::uint64_t whole = one_by_one ? 0 : periods;
    if (whole > 0) {
      add_periods(period, whole);
      firing_ += whole * period.size();
      later += every * whole;
      free_ = period.back().start + Cycles(period.back().interval) + later - every;
      times -= whole;
      if (until_next_row() == 0) in_row_ = false;
      continue;
    }
    for (FiringDates firing : period) {
      firing.free += later;
      firing.ready += later;
      firing.start += later;
      note(firing);
    }
    later += every;
    --times;
  }
  wait_for_row();
}

// `in_row_` is false before the first firing of a row.
void StageTrace::note(const FiringDates& firing) {
  count_periods();
  add_waits(firing, current_.time, waits_);
  if (!in_row_) {
    if (pass_ > 0 || firing_ > 0) end_row(firing);
    begin_row(firing.start);
  }
  if (wants_firings_) note_firing(firing);
  current_.time.of(firing.work) += Cycles(firing.interval);
  ++current_.time.firings;
  ++firing_;
  free_ = firing.start + Cycles(firing.interval);
  in_row_ = until_next_row() > 0;
}

void StageTrace::note_firing(const FiringDates& firing) {
  StageFiring event;
  event.stage = id_;
  event.position = current_.position;
  event.free = date(firing.free);
  event.ready = date(firing.ready);
  event.start = date(firing.start);
  event.end = date(firing.start + Cycles(firing.interval));
  if (!window_.contains(event.position, event.start, event.end)) return;
  event.work = firing.work;
  event.input_wait = firing.input_wait;
  event.room_wait = firing.room_wait;
  if (firing.ready > firing.free) event.input = id_of(firing.input);
  if (firing.start > firing.ready) event.room = id_of(firing.room);
  for (TraceSink* sink : sinks_) sink->firing(event);
}

void StageTrace::add_wait(const Wait& wait, std::vector<Wait>& waits) {
  const auto same = std::find_if(waits.begin(), waits.end(), [&](const Wait& known) {
    return known.activity == wait.activity && known.stream == wait.stream;
  });
  if (same == waits.end()) {
    waits.push_back(wait);
  } else {
    same->cycles += wait.cycles;
  }
}

void StageTrace::add_waits(const FiringDates& firing, StageStatistics& time, std::vector<Wait>& waits) {
  const auto add = [&](StageActivity activity, const StreamBase* stream, Cycles cycles) {
    if (cycles == Cycles(0)) return;
    time.of(activity) += cycles;
    add_wait({activity, stream, cycles}, waits);
  };
  add(firing.input_wait, firing.input, firing.ready - firing.free);
  add(firing.room_wait, firing.room, firing.start - firing.ready);
}

// Periods come a few at a time, and as a rule the same ones: they are counted together.
void StageTrace::add_periods(const std::vector<FiringDates>& period, std::uint64_t times) {
  if (period_.first != period.data() || period_.begin != period.front().start) {
    count_periods();
    period_ = {period.data(), period.front().start, {}, {}};
    for (const FiringDates& firing : period) {
      add_waits(firing, period_.time, period_.waits);
      period_.time.of(firing.work) += Cycles(firing.interval);
      ++period_.time.firings;
    }
  }
  period_.times += times;
}

void StageTrace::count_periods() {
  const std::int64_t times = std::exchange(period_.times, 0);
  if (times == 0) return;
  current_.time.add(period_.time, times);
  for (const Wait& wait : period_.waits) add_wait({wait.activity, wait.stream, wait.cycles * times}, waits_);
}

void StageTrace::begin_row(Cycles start) {
  if (firing_ == schedule_.firings) {
    firing_ = 0;
    row_ = 0;
    ++pass_;
  } else if (firing_ > 0) {
    ++row_;
  }
  const ScheduleRow& row = schedule_row();
  const bool last = row_ + 1 == schedule_.rows.size();
  row_end_ = last ? schedule_.firings : schedule_.rows[row_ + 1].firing;
  // The entry of a row some rows on, which was last read a frame ago, is on its way when it is wanted.
  __builtin_prefetch(&schedule_.rows[std::min(row_ + 4, schedule_.rows.size() - 1)]);
  waits_.clear();
  current_ = {};
  current_.stage = id_;
  current_.position = {pass_ / passes_,
                       static_cast<std::int32_t>(pass_ % passes_) + row.row / rows_of_a_tile_,
                       row.row % rows_of_a_tile_};
  current_.draining = row.draining;
  current_.row_written = row.row_written < 0 ? -1 : row.row_written % rows_of_a_tile_;
  current_.begin = date(start);
  in_window_ = window_.contains(current_.position, current_.begin, current_.begin);
  if (!in_window_) return;
  for (TraceSink* sink : sinks_) sink->row_begins(current_);
}

// The row is over with the firing `next`, whose waits belong to it.
void StageTrace::end_row(const FiringDates& next) {
  current_.busy_until = date(next.free);
  current_.inputs_until = date(next.ready);
  current_.end = date(next.start);
  if (next.ready > next.free) {
    current_.input_wait = next.input_wait;
    current_.input = id_of(next.input);
  }
  if (next.start > next.ready) {
    current_.room_wait = next.room_wait;
    current_.room = id_of(next.room);
  }
  const auto longest = std::max_element(waits_.begin(), waits_.end(),
                                        [](const Wait& a, const Wait& b) { return a.cycles < b.cycles; });
  if (longest != waits_.end()) {
    current_.longest_wait = longest->activity;
    current_.longest_at = id_of(longest->stream);
  }
  if (!in_window_) return;
  for (TraceSink* sink : sinks_) sink->row(current_);
}

void StageTrace::finish() {
  if (pass_ == 0 && firing_ == 0) return;
  count_periods();
  FiringDates none;
  none.free = none.ready = none.start = free_;
  end_row(none);
}

}  // namespace parallax
