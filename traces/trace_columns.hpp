// SPDX-License-Identifier: Apache-2.0
// What CSV and JSON say of each event: one description for both. A `Row` has text(), number() and flag(), each with the
// column's name, which holds the unit. Dates are in ps, waits in cycles; frames count from 1, tiles and rows from 0.
#pragma once

#include <string_view>

#include "traces/trace_event.hpp"

namespace parallax::trace_columns {

inline std::string_view stream_name(const TraceParts& parts, PartId id) {
  return id == kNoPart ? std::string_view() : parts.streams[static_cast<std::size_t>(id)].name;
}

template <class Row>
void put_place(Row& row, const TracePlace& place) {
  row.number("frame", place.frame + 1);
  row.number("tile", place.tile);
  row.number("row", place.row);
}

inline const char* table_of(const StageRow&) { return "rows"; }
template <class Row>
void put(Row& row, const TraceParts& parts, const StageRow& event) {
  row.text("stage", parts.stages[static_cast<std::size_t>(event.stage)].name);
  put_place(row, event.place);
  row.flag("draining", event.draining);
  row.number("row_written", event.row_written);
  row.number("begin_ps", event.begin.count());
  row.number("busy_until_ps", event.busy_until.count());
  row.number("inputs_until_ps", event.inputs_until.count());
  row.number("end_ps", event.end.count());
  row.number("firings", static_cast<std::int64_t>(event.time.firings));
  for (const StageActivity activity : kAllStageActivities) row.number(name_of(activity), event.time.of(activity).count());
  row.text("wait", event.longest_wait == StageActivity::kBusy ? "" : name_of(event.longest_wait));
  row.text("wait_at", stream_name(parts, event.longest_at));
}

inline const char* table_of(const FifoSpan&) { return "fifos"; }
template <class Row>
void put(Row& row, const TraceParts& parts, const FifoSpan& event) {
  row.text("stream", stream_name(parts, event.stream));
  row.number("begin_ps", event.begin.count());
  row.number("end_ps", event.end.count());
  row.number("cycles", static_cast<std::int64_t>(event.cycles));
  row.number("token_cycles", static_cast<std::int64_t>(event.token_cycles));
  row.number("full_cycles", static_cast<std::int64_t>(event.full_cycles));
  row.number("empty_cycles", static_cast<std::int64_t>(event.empty_cycles));
  row.number("written", static_cast<std::int64_t>(event.written));
  row.number("freed", static_cast<std::int64_t>(event.freed));
  row.number("level", static_cast<std::int64_t>(event.level));
}

inline const char* table_of(const PortRow&) { return "ports"; }
template <class Row>
void put(Row& row, const TraceParts& parts, const PortRow& event) {
  row.text("port", parts.ports[static_cast<std::size_t>(event.port)].name);
  put_place(row, event.place);
  row.number("begin_ps", event.begin.count());
  row.number("end_ps", event.end.count());
  row.number("bytes", static_cast<std::int64_t>(event.bytes));
  row.number("bursts", static_cast<std::int64_t>(event.bursts));
  row.number("latency_sum_ps", event.latency.count());
  row.number("latency_longest_ps", event.longest_latency.count());
}

inline const char* table_of(const FrameRecord&) { return "frames"; }
template <class Row>
void put(Row& row, const TraceParts&, const FrameRecord& event) {
  static constexpr const char* kColumns[kFrameSteps] = {
      "exposed_ps",         "first_byte_ps",     "in_memory_ps",         "core_started_ps",
      "first_disparity_ps", "last_disparity_ps", "results_in_memory_ps", "at_host_ps"};
  row.number("frame", event.frame + 1);
  for (std::size_t step = 0; step < kFrameSteps; ++step) row.number(kColumns[step], event.at[step].count());
}

inline const char* table_of(const StageFiring&) { return "firings"; }
template <class Row>
void put(Row& row, const TraceParts& parts, const StageFiring& event) {
  row.text("stage", parts.stages[static_cast<std::size_t>(event.stage)].name);
  put_place(row, event.place);
  row.number("free_ps", event.free.count());
  row.number("ready_ps", event.ready.count());
  row.number("start_ps", event.start.count());
  row.number("end_ps", event.end.count());
  row.text("work", name_of(event.work));
  const bool starved = event.ready > event.free;
  row.text("input_wait", starved ? name_of(event.input_wait) : "");
  row.text("input", stream_name(parts, event.input));
  const bool blocked = event.start > event.ready;
  row.text("room_wait", blocked ? name_of(event.room_wait) : "");
  row.text("room", stream_name(parts, event.room));
}

inline const char* table_of(const TokenTransfer&) { return "tokens"; }
template <class Row>
void put(Row& row, const TraceParts& parts, const TokenTransfer& event) {
  row.text("stream", stream_name(parts, event.stream));
  row.text("side", event.read ? "read" : "write");
  put_place(row, event.place);
  row.number("begin_ps", event.begin.count());
  row.number("end_ps", event.end.count());
}

inline const char* table_of(const BurstTransfer&) { return "bursts"; }
template <class Row>
void put(Row& row, const TraceParts& parts, const BurstTransfer& event) {
  row.text("port", parts.ports[static_cast<std::size_t>(event.port)].name);
  put_place(row, event.place);
  row.text("command", event.write ? "write" : "read");
  row.number("address", static_cast<std::int64_t>(event.address));
  row.number("bytes", static_cast<std::int64_t>(event.bytes));
  row.number("requested_ps", event.requested.count());
  row.number("answered_ps", event.answered.count());
}

}  // namespace parallax::trace_columns
