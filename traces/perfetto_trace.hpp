// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "traces/trace_sink.hpp"

namespace parallax {

/// Writes a trace as Perfetto's TrackEvent packets (protobuf; opens in ui.perfetto.dev and trace_processor). A track for
/// each stage with a slice a row, and its waits between them; a counter for each FIFO (tokens held on average, or each
/// change of the level), and for each memory port; frames in flight; flows that follow a row through all of them. Time
/// there is in whole nanoseconds, so that 1 "ns" is 1 ps: the process says so by its name.
class PerfettoTrace final : public TraceSink {
 public:
  explicit PerfettoTrace(ByteSink sink) : sink_(std::move(sink)) {}

  void begin(const TraceParts& parts) override;
  void row_begins(const StageRow& row) override;
  void row(const StageRow& row) override;
  void fifo(const FifoSpan& span) override;
  void port_row(const PortRow& row) override;
  void frame(const FrameRecord& record) override;
  void firing(const StageFiring& firing) override;
  void token(const TokenTransfer& token) override;
  void requested(const BurstRequest& request) override;
  void burst(const BurstTransfer& burst) override;
  void end(Picoseconds time, const std::vector<EndlessWait>& waits) override;

 private:
  using Track = std::uint64_t;
  struct Argument {
    const char* name;
    std::int64_t number = 0;
    std::string_view text{};  ///< instead of the number, if there is one
  };
  /// Tracks side by side for spans that overlap: each goes to the first that is free.
  struct Lanes {
    std::string name;
    std::vector<std::pair<Track, Picoseconds>> tracks;  // each free from a date on
  };

  Track add_track(const std::string& name, const char* unit = nullptr);
  std::uint64_t interned(std::unordered_map<std::string, std::uint64_t>& names, std::uint32_t field,
                         std::string_view name);
  std::uint64_t flow(const TracePlace& place, std::int32_t row) const;
  Track lane(Lanes& lanes, Picoseconds begin, Picoseconds end);
  void slice_begin(Track track, Picoseconds time, std::string_view name, const std::vector<Argument>& arguments,
                   const std::vector<std::uint64_t>& flows);
  void slice_end(Track track, Picoseconds time, const std::vector<Argument>& arguments = {});
  void slice(Track track, Picoseconds begin, Picoseconds end, std::string_view name,
             const std::vector<Argument>& arguments = {}, const std::vector<std::uint64_t>& flows = {});
  void wait(Track track, Picoseconds begin, Picoseconds end, StageActivity activity, PartId stream);
  template <class Value>
  void counter(Track track, Picoseconds time, Value value);
  void write_if_full();

  ByteSink sink_;
  std::string bytes_;
  TraceParts parts_;
  Track last_track_ = 1;  // 1 is the process
  std::unordered_map<std::string, std::uint64_t> event_names_, argument_names_;
  std::string scratch_;
  std::vector<Track> stages_, ports_, fifo_counters_, rate_counters_, request_counters_;
  std::vector<std::int64_t> levels_, requests_;  // of FIFOs and ports, token by token
  std::vector<Picoseconds> rate_until_;
  std::vector<Lanes> bursts_;
  Lanes frames_;
};

}  // namespace parallax
