// SPDX-License-Identifier: Apache-2.0
// What CSV and JSON say of each event: one description for both. A `Row` has text(), number(), date() and
// flag(), each with the column's name, which holds the unit. Dates are in ps, waits in cycles; frames count
// from 1, tiles and rows from 0.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "traces/trace_event.hpp"

namespace parallax::trace_columns {

/// Of a part; empty for kNoPart.
template <class Part>
std::string_view name_of(const std::vector<Part>& parts, PartId id) {
  return id == kNoPart ? std::string_view("") : parts[id].name;
}

template <class Row>
void put_position(Row& row, const TracePosition& position) {
  row.number("frame", position.frame + 1);
  row.number("tile", position.tile);
  row.number("row", position.row);
}

constexpr std::string_view table_of(const StageRow&) { return "rows"; }
template <class Row>
void put(Row& row, const TraceParts& parts, const StageRow& event) {
  row.text("stage", name_of(parts.stages, event.stage));
  put_position(row, event.position);
  row.flag("draining", event.draining);
  row.number("row_written", event.row_written);
  row.date("begin_ps", event.begin);
  row.date("busy_until_ps", event.busy_until);
  row.date("inputs_until_ps", event.inputs_until);
  row.date("end_ps", event.end);
  row.number("firings", event.time.firings);
  row.number("busy", event.time.busy.count());
  row.number("starved", event.time.starved.count());
  row.number("blocked", event.time.blocked.count());
  row.number("memory", event.time.memory.count());
  row.number("synchroniser", event.time.synchroniser.count());
  row.number("blanking", event.time.blanking.count());
  row.text("wait", event.longest_wait == StageActivity::kBusy ? "" : parallax::name_of(event.longest_wait));
  row.text("wait_at", name_of(parts.streams, event.longest_at));
}

constexpr std::string_view table_of(const FifoSpan&) { return "fifos"; }
template <class Row>
void put(Row& row, const TraceParts& parts, const FifoSpan& event) {
  row.text("stream", name_of(parts.streams, event.stream));
  row.date("begin_ps", event.begin);
  row.date("end_ps", event.end);
  row.number("cycles", event.cycles);
  row.number("token_cycles", event.token_cycles);
  row.number("full_cycles", event.full_cycles);
  row.number("empty_cycles", event.empty_cycles);
  row.number("written", event.written);
  row.number("freed", event.freed);
  row.number("level", event.level);
}

constexpr std::string_view table_of(const PortRow&) { return "ports"; }
template <class Row>
void put(Row& row, const TraceParts& parts, const PortRow& event) {
  row.text("port", name_of(parts.ports, event.port));
  put_position(row, event.position);
  row.date("begin_ps", event.begin);
  row.date("end_ps", event.end);
  row.number("bytes", event.bytes);
  row.number("bursts", event.bursts);
  row.number("latency_sum_ps", event.latency.count());
  row.number("latency_longest_ps", event.longest_latency.count());
}

constexpr std::string_view table_of(const FrameRecord&) { return "frames"; }
template <class Row>
void put(Row& row, const TraceParts&, const FrameRecord& event) {
  const auto at = [&event](FrameStep step) { return event.at[index_of(step)]; };
  row.number("frame", event.frame + 1);
  row.date("exposed_ps", at(FrameStep::kExposed));
  row.date("first_byte_ps", at(FrameStep::kFirstByte));
  row.date("startable_ps", at(FrameStep::kStartable));
  row.date("in_memory_ps", at(FrameStep::kInMemory));
  row.date("core_started_ps", at(FrameStep::kCoreStarted));
  row.date("first_disparity_ps", at(FrameStep::kFirstDisparity));
  row.date("last_disparity_ps", at(FrameStep::kLastDisparity));
  row.date("results_in_memory_ps", at(FrameStep::kResultsInMemory));
  row.date("at_host_ps", at(FrameStep::kAtHost));
}

constexpr std::string_view table_of(const StageFiring&) { return "firings"; }
template <class Row>
void put(Row& row, const TraceParts& parts, const StageFiring& event) {
  row.text("stage", name_of(parts.stages, event.stage));
  put_position(row, event.position);
  row.date("free_ps", event.free);
  row.date("ready_ps", event.ready);
  row.date("start_ps", event.start);
  row.date("end_ps", event.end);
  row.text("work", parallax::name_of(event.work));
  const bool starved = event.ready > event.free;
  row.text("input_wait", starved ? parallax::name_of(event.input_wait) : "");
  row.text("input", name_of(parts.streams, event.input));
  const bool blocked = event.start > event.ready;
  row.text("room_wait", blocked ? parallax::name_of(event.room_wait) : "");
  row.text("room", name_of(parts.streams, event.room));
}

constexpr std::string_view table_of(const TokenTransfer&) { return "tokens"; }
template <class Row>
void put(Row& row, const TraceParts& parts, const TokenTransfer& event) {
  row.text("stream", name_of(parts.streams, event.stream));
  row.text("side", event.read ? "read" : "write");
  put_position(row, event.position);
  row.date("begin_ps", event.begin);
  row.date("end_ps", event.end);
  row.number("level", event.level);
}

constexpr std::string_view table_of(const BurstTransfer&) { return "bursts"; }
template <class Row>
void put(Row& row, const TraceParts& parts, const BurstTransfer& event) {
  row.text("port", name_of(parts.ports, event.port));
  put_position(row, event.position);
  row.text("command", event.write ? "write" : "read");
  row.number("address", event.address);
  row.number("bytes", event.bytes);
  row.date("requested_ps", event.requested);
  row.date("answered_ps", event.answered);
}

/// The columns of a kind of event, in order.
template <class Event>
std::vector<std::string> names() {
  struct Names {
    std::vector<std::string> all;
    void text(std::string_view name, std::string_view) { all.emplace_back(name); }
    void number(std::string_view name, std::int64_t) { all.emplace_back(name); }
    void date(std::string_view name, Picoseconds) { all.emplace_back(name); }
    void flag(std::string_view name, bool) { all.emplace_back(name); }
  } names;
  put(names, {}, Event{});  // names do not depend on values
  return names.all;
}

}  // namespace parallax::trace_columns
