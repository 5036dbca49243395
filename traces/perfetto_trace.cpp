// SPDX-License-Identifier: Apache-2.0
#include "traces/perfetto_trace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace parallax {
namespace {

// Names of events and of their arguments go into the file once, and are numbers from then on.
enum EventName : std::uint64_t {
  kBusy = 1,  // those of StageActivity, in its order
  kUpstreamEmpty,
  kDownstreamFull,
  kMemory,
  kSynchroniser,
  kBlanking,
  kFiring,
  kOverhead,
  kRead,
  kWrite,
  kReadOut,
  kWaitsForCore,
  kInCore,
  kToHost,
  kStuckEmpty,
  kStuckFull,
};
constexpr std::string_view kEventNames[] = {"busy",
                                            "upstream empty",
                                            "downstream full",
                                            "memory",
                                            "synchroniser",
                                            "blanking",
                                            "firing",
                                            "overhead",
                                            "read",
                                            "write",
                                            "read out",
                                            "waits for the core",
                                            "in the core",
                                            "to the host",
                                            "stuck: upstream empty",
                                            "stuck: downstream full"};

enum ArgumentName : std::uint64_t {
  kBusyCycles = 1,  // those of StageActivity, in its order
  kFirings = 7,
  kFrame,
  kTile,
  kRow,
  kRowWritten,
  kWaitedFor,
  kAt,
  kDepth,
  kBytes,
  kBursts,
  kAddress,
  kLatencyMean,
  kLatencyLongest,
  kFirstDisparity,
  kLastDisparity,
};
constexpr std::string_view kArgumentNames[] = {"busy_cycles",
                                               "starved_cycles",
                                               "blocked_cycles",
                                               "memory_cycles",
                                               "synchroniser_cycles",
                                               "blanking_cycles",
                                               "firings",
                                               "frame",
                                               "tile",
                                               "row",
                                               "row_written",
                                               "waited_for",
                                               "at",
                                               "depth",
                                               "bytes",
                                               "bursts",
                                               "address",
                                               "latency_mean_ps",
                                               "latency_longest_ps",
                                               "first_disparity_ps",
                                               "last_disparity_ps"};

std::uint64_t name_number(StageActivity activity) { return kBusy + index_of(activity); }
std::string_view title_of(StageActivity activity) { return kEventNames[index_of(activity)]; }

}  // namespace

void PerfettoTrace::begin(const TraceParts& parts) {
  parts_ = parts;
  out_.begin();
  for (const std::string_view name : kEventNames) out_.add_event_name(name);
  for (const std::string_view name : kArgumentNames) out_.add_argument_name(name);
  frames_.name = "frame in flight";
  for (const TraceParts::StagePart& stage : parts.stages) stages_.push_back(out_.add_track(stage.name));
  for (const TraceParts::PortPart& port : parts.ports) {
    ports_.push_back(out_.add_track("memory: " + port.name));
    rate_counters_.push_back(out_.add_track("memory: " + port.name + " rate", "MB/s"));
    if (parts.tokens)
      request_counters_.push_back(out_.add_track("memory: " + port.name + " requests under way", "bursts"));
    bursts_.push_back({"memory: " + port.name + " burst", {}});
  }
  rate_until_.resize(parts.ports.size());
  for (const TraceParts::StreamPart& stream : parts.streams) {
    fifo_counters_.push_back(out_.add_track(
        fmt::format("FIFO: {} ({}depth {})", stream.name, parts.tokens ? "" : "mean, ", stream.depth),
        "tokens"));
  }
}

std::uint64_t PerfettoTrace::row_name(const TracePosition& position, bool draining) {
  std::vector<std::uint64_t>& numbers = row_names_[draining ? 1 : 0];
  const std::size_t row = position.row;
  if (row >= numbers.size()) numbers.resize(row + 1);
  if (numbers[row] == 0) {
    numbers[row] = out_.add_event_name(fmt::format(draining ? "row {} out" : "row {}", row));
  }
  return numbers[row];
}

// A row of a frame has one number, wherever it is.
std::uint64_t PerfettoTrace::flow(const TracePosition& position, std::int32_t row) const {
  const std::int64_t tile = position.frame * parts_.tiles + position.tile;
  return tile * parts_.rows + row + 1;
}

PerfettoTrace::Track PerfettoTrace::lane(Lanes& lanes, Picoseconds begin, Picoseconds end) {
  for (auto& [track, free] : lanes.tracks) {
    if (free > begin) continue;
    free = end;
    return track;
  }
  lanes.tracks.emplace_back(out_.add_track(fmt::format("{} {}", lanes.name, lanes.tracks.size() + 1)), end);
  return lanes.tracks.back().first;
}

void PerfettoTrace::wait(Track track, Picoseconds begin, Picoseconds end, StageActivity activity,
                         PartId stream) {
  if (begin == end) return;
  {
    PerfettoEvent event = out_.event(begin, Type::kSliceBegin, track);
    event.name(name_number(activity));
    if (stream != kNoPart) event.argument(kAt, parts_.streams[stream].name);
  }
  out_.slice_end(track, end);
}

void PerfettoTrace::row_begins(const RowBegin& row) {
  const std::uint64_t name = row_name(row.position, row.draining);
  PerfettoEvent event = out_.event(row.begin, Type::kSliceBegin, stages_[row.stage]);
  event.name(name);
  event.flow(flow(row.position, row.position.row));
  if (row.row_written >= 0 && row.row_written != row.position.row)
    event.flow(flow(row.position, row.row_written));
  event.argument(kFrame, row.position.frame + 1);
  event.argument(kRow, row.position.row);
  if (parts_.tiles > 1) event.argument(kTile, row.position.tile);
  if (row.row_written >= 0) event.argument(kRowWritten, row.row_written);
}

void PerfettoTrace::row(const StageRow& row) {
  const Track track = stages_[row.stage];
  {
    PerfettoEvent event = out_.event(row.busy_until, Type::kSliceEnd, track);
    event.argument(kFirings, row.time.firings);
    // Of the row and of the wait after it, so that a stage's numbers are the sums over its rows.
    for (const StageActivity activity : kAllStageActivities) {
      const Cycles cycles = row.time.of(activity);
      if (cycles > Cycles(0)) event.argument(kBusyCycles + index_of(activity), cycles.count());
    }
    if (row.longest_wait != StageActivity::kBusy) {
      event.argument(kWaitedFor, title_of(row.longest_wait));
      if (row.longest_at != kNoPart) {
        event.argument(kAt, parts_.streams[row.longest_at].name);
      }
    }
  }
  wait(track, row.busy_until, row.inputs_until, row.input_wait, row.input);
  wait(track, row.inputs_until, row.end, row.room_wait, row.room);
}

void PerfettoTrace::firing(const StageFiring& firing) {
  // The waits before a row's first firing are told with the row before.
  out_.slice(stages_[firing.stage], firing.start, firing.end,
             firing.work == StageActivity::kBlanking ? kOverhead : kFiring);
}

void PerfettoTrace::fifo(const FifoSpan& span) {
  if (!parts_.tokens) out_.counter(fifo_counters_[span.stream], span.begin, span.mean());
}

void PerfettoTrace::token(const TokenTransfer& token) {
  // What a register shows after the cycle.
  out_.counter(fifo_counters_[token.stream], token.end, token.level);
}

void PerfettoTrace::port_row(const PortRow& row) {
  const std::size_t port = row.port;
  const std::uint64_t name = row_name(row.position, false);
  {
    PerfettoEvent event = out_.event(row.begin, Type::kSliceBegin, ports_[port]);
    event.name(name);
    event.flow(flow(row.position, row.position.row));
    event.argument(kFrame, row.position.frame + 1);
    event.argument(kRow, row.position.row);
    event.argument(kBytes, row.bytes);
    event.argument(kBursts, row.bursts);
    event.argument(kLatencyMean,
                   row.bursts == 0 ? 0 : row.latency.count() / static_cast<std::int64_t>(row.bursts));
    event.argument(kLatencyLongest, row.longest_latency.count());
  }
  out_.slice_end(ports_[port], row.end);
  if (row.begin > rate_until_[port]) out_.counter(rate_counters_[port], rate_until_[port], 0.0);
  if (row.end > row.begin) {
    out_.counter(rate_counters_[port], row.begin,
                 static_cast<double>(row.bytes) * 1e6 / (row.end - row.begin).real());
  }
  rate_until_[port] = row.end;
}

void PerfettoTrace::requests(const PortRequests& requests) {
  out_.counter(request_counters_[requests.port], requests.time, requests.under_way);
}

void PerfettoTrace::burst(const BurstTransfer& burst) {
  const Track track = lane(bursts_[burst.port], burst.requested, burst.answered);
  {
    PerfettoEvent event = out_.event(burst.requested, Type::kSliceBegin, track);
    event.name(burst.write ? kWrite : kRead);
    event.argument(kAddress, burst.address);
    event.argument(kBytes, burst.bytes);
  }
  out_.slice_end(track, burst.answered);
}

void PerfettoTrace::frame(const FrameRecord& record) {
  const auto at = [&record](FrameStep step) { return record.at[index_of(step)]; };
  const Track track = lane(frames_, at(FrameStep::kExposed), at(FrameStep::kAtHost));
  const std::uint64_t name = out_.add_event_name(fmt::format("frame {}", record.frame + 1));
  {
    PerfettoEvent event = out_.event(at(FrameStep::kExposed), Type::kSliceBegin, track);
    event.name(name);
    event.argument(kFrame, record.frame + 1);
    event.argument(kFirstDisparity, at(FrameStep::kFirstDisparity).count());
    event.argument(kLastDisparity, at(FrameStep::kLastDisparity).count());
  }
  const auto part = [&](FrameStep from, FrameStep to, EventName what) {
    if (at(from) < at(to)) out_.slice(track, at(from), at(to), what);
  };
  part(FrameStep::kExposed, FrameStep::kStartable, kReadOut);
  part(FrameStep::kStartable, FrameStep::kCoreStarted, kWaitsForCore);
  part(FrameStep::kCoreStarted, FrameStep::kResultsInMemory, kInCore);
  part(FrameStep::kResultsInMemory, FrameStep::kAtHost, kToHost);
  out_.slice_end(track, at(FrameStep::kAtHost));
}

void PerfettoTrace::end(Picoseconds time, const std::vector<EndlessWait>& waits) {
  for (const EndlessWait& wait : waits) {
    for (std::size_t stage = 0; stage < parts_.stages.size(); ++stage) {
      if (parts_.stages[stage].path != wait.waiter) continue;
      PerfettoEvent event = out_.event(time, Type::kSliceBegin, stages_[stage]);
      event.name(wait.on_full ? kStuckFull : kStuckEmpty);
      event.argument(kAt, wait.stream);
      event.argument(kDepth, wait.depth);
    }
  }
  out_.write();
}

}  // namespace parallax
