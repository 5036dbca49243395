// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "traces/perfetto_event.hpp"
#include "traces/text_buffer.hpp"
#include "traces/trace_sink.hpp"

namespace parallax {

/// Writes a trace as Perfetto's TrackEvent packets (protobuf; opens in ui.perfetto.dev and trace_processor).
/// A track for each stage with a slice a row, and its waits between them; a counter for each FIFO (tokens
/// held on average, or each change of the level), and for each memory port; frames in flight; flows that
/// follow a row through all of them. Time there is in whole nanoseconds, so that 1 "ns" is 1 ps: the process
/// says so by its name.
class PerfettoTrace final : public TraceSink {
 public:
  explicit PerfettoTrace(ByteSink sink) : out_(std::move(sink)) {}

  void begin(const TraceParts& parts) override;
  void row_begins(const RowBegin& row) override;
  void row(const StageRow& row) override;
  void fifo(const FifoSpan& span) override;
  void port_row(const PortRow& row) override;
  void frame(const FrameRecord& record) override;
  void firing(const StageFiring& firing) override;
  void token(const TokenTransfer& token) override;
  void requests(const PortRequests& requests) override;
  void burst(const BurstTransfer& burst) override;
  void end(Picoseconds time, const std::vector<EndlessWait>& waits) override;

 private:
  using Track = std::uint64_t;
  using Type = PerfettoEvent::Type;
  /// Tracks side by side for spans that overlap: each goes to the first that is free.
  struct Lanes {
    std::string name;
    std::vector<std::pair<Track, Picoseconds>> tracks;  // each free from a date on
  };

  void add_packet(std::string_view packet);
  Track add_track(const std::string& name, const char* unit = nullptr);
  std::uint64_t intern(std::uint32_t list, std::uint64_t number, std::string_view name);
  std::uint64_t row_name(const TracePosition& position, bool draining);
  std::uint64_t flow(const TracePosition& position, std::int32_t row) const;
  Track lane(Lanes& lanes, Picoseconds begin, Picoseconds end);
  void slice(Track track, Picoseconds begin, Picoseconds end, std::uint64_t name);
  void slice_end(Track track, Picoseconds time) { PerfettoEvent(out_, time, Type::kSliceEnd, track); }
  void wait(Track track, Picoseconds begin, Picoseconds end, StageActivity activity, PartId stream);
  template <class Value>
  void counter(Track track, Picoseconds time, Value value) {
    PerfettoEvent(out_, time, Type::kCounter, track).counter(value);
  }

  TextBuffer out_;
  TraceParts parts_;
  Track last_track_ = 1;  // 1 is the process
  std::uint64_t last_event_name_ = 0;
  std::array<std::vector<std::uint64_t>, 2> row_names_;  // numbers of "row 7" and "row 7 out"; 0: none yet
  std::vector<Track> stages_, ports_, fifo_counters_, rate_counters_, request_counters_;
  std::vector<Picoseconds> rate_until_;
  std::vector<Lanes> bursts_;
  Lanes frames_;
};

}  // namespace parallax
