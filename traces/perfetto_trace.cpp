// SPDX-License-Identifier: Apache-2.0
#include "traces/perfetto_trace.hpp"

#include <fmt/format.h>

#include <array>
#include <protozero/pbf_writer.hpp>
#include <utility>

namespace parallax {
namespace {

// Numbers of fields in perfetto's trace_packet.proto, track_event.proto, track_descriptor.proto, interned_data.proto and
// debug_annotation.proto.
namespace field {
constexpr std::uint32_t kPacket = 1;
constexpr std::uint32_t kTimestamp = 8, kSequence = 10, kTrackEvent = 11, kInternedData = 12, kSequenceFlags = 13,
                        kTrackDescriptor = 60;
constexpr std::uint32_t kEventNames = 2, kAnnotationNames = 3, kEntryNumber = 1, kEntryName = 2;
constexpr std::uint32_t kUuid = 1, kName = 2, kProcess = 3, kParent = 5, kCounter = 8;
constexpr std::uint32_t kPid = 1, kProcessName = 6, kUnitName = 6;
constexpr std::uint32_t kAnnotation = 4, kType = 9, kNameNumber = 10, kTrack = 11, kCounterValue = 30,
                        kDoubleCounterValue = 44, kFlow = 47;
constexpr std::uint32_t kAnnotationName = 1, kIntValue = 4, kStringValue = 6;
}  // namespace field

constexpr std::uint64_t kProcessTrack = 1;
constexpr std::uint32_t kOurSequence = 1;
constexpr std::uint32_t kStateCleared = 1, kNeedsState = 2;
enum EventType : std::int32_t { kSliceBegin = 1, kSliceEnd = 2, kCounterEvent = 4 };
constexpr std::size_t kPiece = 1 << 16;  // bytes that are written at once

std::uint64_t time_of(Picoseconds date) { return static_cast<std::uint64_t>(date.count()); }

const char* title_of(StageActivity activity) {
  switch (activity) {
    case StageActivity::kStarved:
      return "upstream empty";
    case StageActivity::kBlocked:
      return "downstream full";
    case StageActivity::kMemory:
      return "memory";
    case StageActivity::kSynchroniser:
      return "synchroniser";
    case StageActivity::kBlanking:
      return "blanking";
    case StageActivity::kBusy:
      break;
  }
  return "busy";
}

}  // namespace

std::uint64_t PerfettoTrace::interned(std::unordered_map<std::string, std::uint64_t>& names, std::uint32_t list,
                                      std::string_view name) {
  scratch_.assign(name);
  const auto found = names.find(scratch_);
  if (found != names.end()) return found->second;
  const std::uint64_t number = names.size() + 1;
  names.emplace(scratch_, number);
  protozero::pbf_writer trace(bytes_);
  protozero::pbf_writer packet(trace, field::kPacket);
  packet.add_uint32(field::kSequence, kOurSequence);
  packet.add_uint32(field::kSequenceFlags, kNeedsState);
  protozero::pbf_writer data(packet, field::kInternedData);
  protozero::pbf_writer entry(data, list);
  entry.add_uint64(field::kEntryNumber, number);
  entry.add_string(field::kEntryName, scratch_);
  return number;
}

PerfettoTrace::Track PerfettoTrace::add_track(const std::string& name, const char* unit) {
  const Track track = ++last_track_;
  protozero::pbf_writer trace(bytes_);
  protozero::pbf_writer packet(trace, field::kPacket);
  packet.add_uint32(field::kSequence, kOurSequence);
  protozero::pbf_writer descriptor(packet, field::kTrackDescriptor);
  descriptor.add_uint64(field::kUuid, track);
  descriptor.add_string(field::kName, name);
  descriptor.add_uint64(field::kParent, kProcessTrack);
  if (unit != nullptr) {
    protozero::pbf_writer counter(descriptor, field::kCounter);
    counter.add_string(field::kUnitName, unit);
  }
  return track;
}

void PerfettoTrace::begin(const TraceParts& parts) {
  parts_ = parts;
  {
    protozero::pbf_writer trace(bytes_);
    protozero::pbf_writer packet(trace, field::kPacket);
    packet.add_uint32(field::kSequence, kOurSequence);
    packet.add_uint32(field::kSequenceFlags, kStateCleared);
    protozero::pbf_writer descriptor(packet, field::kTrackDescriptor);
    descriptor.add_uint64(field::kUuid, kProcessTrack);
    protozero::pbf_writer process(descriptor, field::kProcess);
    process.add_int32(field::kPid, 1);
    process.add_string(field::kProcessName, "Parallax: 1 ns shown is 1 ps, so 1 s is 1 ms");
  }
  frames_.name = "frame in flight";
  for (const TraceParts::StagePart& stage : parts.stages) stages_.push_back(add_track(stage.name));
  for (const TraceParts::PortPart& port : parts.ports) {
    ports_.push_back(add_track("memory: " + port.name));
    rate_counters_.push_back(add_track("memory: " + port.name + " rate", "MB/s"));
    if (parts.tokens) request_counters_.push_back(add_track("memory: " + port.name + " requests under way", "bursts"));
    bursts_.push_back({"memory: " + port.name + " burst", {}});
  }
  rate_until_.resize(parts.ports.size());
  requests_.resize(parts.ports.size());
  for (const TraceParts::StreamPart& stream : parts.streams) {
    fifo_counters_.push_back(add_track(
        fmt::format("FIFO: {} ({}depth {})", stream.name, parts.tokens ? "" : "mean, ", stream.depth), "tokens"));
  }
  levels_.resize(parts.streams.size());
  write_if_full();
}

// A row of a frame has one number, wherever it is.
std::uint64_t PerfettoTrace::flow(const TracePlace& place, std::int32_t row) const {
  const std::int64_t tile = place.frame * parts_.tiles + place.tile;
  return static_cast<std::uint64_t>(tile * parts_.rows + row + 1);
}

PerfettoTrace::Track PerfettoTrace::lane(Lanes& lanes, Picoseconds begin, Picoseconds end) {
  for (auto& [track, free] : lanes.tracks) {
    if (free > begin) continue;
    free = end;
    return track;
  }
  lanes.tracks.emplace_back(add_track(fmt::format("{} {}", lanes.name, lanes.tracks.size() + 1)), end);
  return lanes.tracks.back().first;
}

void PerfettoTrace::slice_begin(Track track, Picoseconds time, std::string_view name,
                                const std::vector<Argument>& arguments, const std::vector<std::uint64_t>& flows) {
  const std::uint64_t name_number = interned(event_names_, field::kEventNames, name);
  std::array<std::uint64_t, 16> argument_numbers{};
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    argument_numbers.at(i) = interned(argument_names_, field::kAnnotationNames, arguments[i].name);
  }
  protozero::pbf_writer trace(bytes_);
  protozero::pbf_writer packet(trace, field::kPacket);
  packet.add_uint64(field::kTimestamp, time_of(time));
  packet.add_uint32(field::kSequence, kOurSequence);
  packet.add_uint32(field::kSequenceFlags, kNeedsState);
  protozero::pbf_writer event(packet, field::kTrackEvent);
  event.add_enum(field::kType, kSliceBegin);
  event.add_uint64(field::kNameNumber, name_number);
  event.add_uint64(field::kTrack, track);
  for (const std::uint64_t id : flows) event.add_fixed64(field::kFlow, id);
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    protozero::pbf_writer annotation(event, field::kAnnotation);
    annotation.add_uint64(field::kAnnotationName, argument_numbers.at(i));
    if (arguments[i].text.empty()) {
      annotation.add_int64(field::kIntValue, arguments[i].number);
    } else {
      annotation.add_string(field::kStringValue, arguments[i].text.data(), arguments[i].text.size());
    }
  }
}

void PerfettoTrace::slice_end(Track track, Picoseconds time, const std::vector<Argument>& arguments) {
  std::array<std::uint64_t, 16> argument_numbers{};
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    argument_numbers.at(i) = interned(argument_names_, field::kAnnotationNames, arguments[i].name);
  }
  protozero::pbf_writer trace(bytes_);
  protozero::pbf_writer packet(trace, field::kPacket);
  packet.add_uint64(field::kTimestamp, time_of(time));
  packet.add_uint32(field::kSequence, kOurSequence);
  packet.add_uint32(field::kSequenceFlags, kNeedsState);
  protozero::pbf_writer event(packet, field::kTrackEvent);
  event.add_enum(field::kType, kSliceEnd);
  event.add_uint64(field::kTrack, track);
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    protozero::pbf_writer annotation(event, field::kAnnotation);
    annotation.add_uint64(field::kAnnotationName, argument_numbers.at(i));
    if (arguments[i].text.empty()) {
      annotation.add_int64(field::kIntValue, arguments[i].number);
    } else {
      annotation.add_string(field::kStringValue, arguments[i].text.data(), arguments[i].text.size());
    }
  }
}

void PerfettoTrace::slice(Track track, Picoseconds begin, Picoseconds end, std::string_view name,
                          const std::vector<Argument>& arguments, const std::vector<std::uint64_t>& flows) {
  slice_begin(track, begin, name, arguments, flows);
  slice_end(track, end);
}

void PerfettoTrace::wait(Track track, Picoseconds begin, Picoseconds end, StageActivity activity, PartId stream) {
  if (begin == end) return;
  if (stream == kNoPart) {
    slice(track, begin, end, title_of(activity));
  } else {
    slice(track, begin, end, title_of(activity), {{"at", 0, parts_.streams[static_cast<std::size_t>(stream)].name}});
  }
}

template <class Value>
void PerfettoTrace::counter(Track track, Picoseconds time, Value value) {
  protozero::pbf_writer trace(bytes_);
  protozero::pbf_writer packet(trace, field::kPacket);
  packet.add_uint64(field::kTimestamp, time_of(time));
  packet.add_uint32(field::kSequence, kOurSequence);
  protozero::pbf_writer event(packet, field::kTrackEvent);
  event.add_enum(field::kType, kCounterEvent);
  event.add_uint64(field::kTrack, track);
  if constexpr (std::is_integral_v<Value>) {
    event.add_int64(field::kCounterValue, value);
  } else {
    event.add_double(field::kDoubleCounterValue, value);
  }
}

void PerfettoTrace::write_if_full() {
  if (bytes_.size() < kPiece) return;
  sink_(bytes_);
  bytes_.clear();
}

void PerfettoTrace::row_begins(const StageRow& row) {
  const Track track = stages_[static_cast<std::size_t>(row.stage)];
  std::vector<std::uint64_t> flows{flow(row.place, row.place.row)};
  if (row.row_written >= 0 && row.row_written != row.place.row) flows.push_back(flow(row.place, row.row_written));
  std::vector<Argument> arguments{{"frame", row.place.frame + 1}, {"row", row.place.row}};
  if (parts_.tiles > 1) arguments.push_back({"tile", row.place.tile});
  if (row.row_written >= 0) arguments.push_back({"row_written", row.row_written});
  slice_begin(track, row.begin, fmt::format(row.draining ? "row {} out" : "row {}", row.place.row), arguments, flows);
}

void PerfettoTrace::row(const StageRow& row) {
  const Track track = stages_[static_cast<std::size_t>(row.stage)];
  std::vector<Argument> arguments{{"firings", static_cast<std::int64_t>(row.time.firings)}};
  // Of the row and of the wait after it, so that a stage's numbers are the sums over its rows.
  static constexpr std::array<const char*, kAllStageActivities.size()> kNames{
      "busy_cycles", "starved_cycles", "blocked_cycles", "memory_cycles", "synchroniser_cycles", "blanking_cycles"};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const Cycles cycles = row.time.of(kAllStageActivities[i]);
    if (cycles > Cycles(0)) arguments.push_back({kNames[i], cycles.count()});
  }
  if (row.longest_wait != StageActivity::kBusy) {
    arguments.push_back({"waited_for", 0, title_of(row.longest_wait)});
    if (row.longest_at != kNoPart) {
      arguments.push_back({"at", 0, parts_.streams[static_cast<std::size_t>(row.longest_at)].name});
    }
  }
  slice_end(track, row.busy_until, arguments);
  wait(track, row.busy_until, row.inputs_until, row.input_wait, row.input);
  wait(track, row.inputs_until, row.end, row.room_wait, row.room);
  write_if_full();
}

void PerfettoTrace::firing(const StageFiring& firing) {
  const Track track = stages_[static_cast<std::size_t>(firing.stage)];
  // The waits before a row's first firing are told with the row before.
  slice(track, firing.start, firing.end, firing.work == StageActivity::kBlanking ? "overhead" : "firing");
  write_if_full();
}

void PerfettoTrace::fifo(const FifoSpan& span) {
  if (parts_.tokens) return;
  const Track track = fifo_counters_[static_cast<std::size_t>(span.stream)];
  counter(track, span.begin, span.mean());
  write_if_full();
}

void PerfettoTrace::token(const TokenTransfer& token) {
  const auto stream = static_cast<std::size_t>(token.stream);
  levels_[stream] += token.read ? -1 : 1;
  counter(fifo_counters_[stream], token.end, levels_[stream]);  // what a register shows after the cycle
  write_if_full();
}

void PerfettoTrace::port_row(const PortRow& row) {
  const auto port = static_cast<std::size_t>(row.port);
  const std::int64_t mean = row.bursts == 0 ? 0 : row.latency.count() / static_cast<std::int64_t>(row.bursts);
  slice(ports_[port], row.begin, row.end, fmt::format("row {}", row.place.row),
        {{"frame", row.place.frame + 1},
         {"row", row.place.row},
         {"bytes", static_cast<std::int64_t>(row.bytes)},
         {"bursts", static_cast<std::int64_t>(row.bursts)},
         {"latency_mean_ps", mean},
         {"latency_longest_ps", row.longest_latency.count()}},
        {flow(row.place, row.place.row)});
  if (row.begin > rate_until_[port]) counter(rate_counters_[port], rate_until_[port], 0.0);
  if (row.end > row.begin) {
    counter(rate_counters_[port], row.begin,
            static_cast<double>(row.bytes) * 1e6 / static_cast<double>((row.end - row.begin).count()));
  }
  rate_until_[port] = row.end;
  write_if_full();
}

void PerfettoTrace::requested(const BurstRequest& request) {
  const auto port = static_cast<std::size_t>(request.port);
  counter(request_counters_[port], request.time, ++requests_[port]);
}

void PerfettoTrace::burst(const BurstTransfer& burst) {
  const auto port = static_cast<std::size_t>(burst.port);
  counter(request_counters_[port], burst.answered, --requests_[port]);
  slice(lane(bursts_[port], burst.requested, burst.answered), burst.requested, burst.answered,
        burst.write ? "write" : "read",
        {{"address", static_cast<std::int64_t>(burst.address)}, {"bytes", static_cast<std::int64_t>(burst.bytes)}});
  write_if_full();
}

void PerfettoTrace::frame(const FrameRecord& record) {
  const auto at = [&record](FrameStep step) { return record.at[static_cast<std::size_t>(step)]; };
  const Track track = lane(frames_, at(FrameStep::kExposed), at(FrameStep::kAtHost));
  slice_begin(track, at(FrameStep::kExposed), fmt::format("frame {}", record.frame + 1),
              {{"frame", record.frame + 1},
               {"first_disparity_ps", at(FrameStep::kFirstDisparity).count()},
               {"last_disparity_ps", at(FrameStep::kLastDisparity).count()}},
              {});
  const auto part = [&](FrameStep from, FrameStep to, const char* name) {
    if (at(from) < at(to)) slice(track, at(from), at(to), name);
  };
  part(FrameStep::kExposed, FrameStep::kInMemory, "read out");
  part(FrameStep::kInMemory, FrameStep::kCoreStarted, "waits for the core");
  part(FrameStep::kCoreStarted, FrameStep::kResultsInMemory, "in the core");
  part(FrameStep::kResultsInMemory, FrameStep::kAtHost, "to the host");
  slice_end(track, at(FrameStep::kAtHost));
  write_if_full();
}

void PerfettoTrace::end(Picoseconds time, const std::vector<EndlessWait>& waits) {
  for (const EndlessWait& wait : waits) {
    for (std::size_t stage = 0; stage < parts_.stages.size(); ++stage) {
      if (parts_.stages[stage].path != wait.waiter) continue;
      slice_begin(stages_[stage], time, wait.on_full ? "stuck: downstream full" : "stuck: upstream empty",
                  {{"at", 0, wait.stream}, {"depth", wait.depth}}, {});
    }
  }
  sink_(bytes_);
  bytes_.clear();
}

}  // namespace parallax
