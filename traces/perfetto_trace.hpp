// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "traces/perfetto_writer.hpp"
#include "traces/trace_sink.hpp"

namespace parallax {

/// Writes a trace for Perfetto: a track for each stage with a slice a row, and its waits between them; a
/// counter for each FIFO (tokens held on average, or each change of the level), and for each memory port;
/// frames in flight; flows that follow a row through all of them.
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
  using Track = PerfettoWriter::Track;
  using Type = PerfettoEvent::Type;
  /// Tracks side by side for spans that overlap: each goes to the first that is free.
  struct Lanes {
    std::string name;
    std::vector<std::pair<Track, Picoseconds>> tracks;  // each free from a date on
  };

  std::uint64_t row_name(const TracePosition& position, bool draining);
  std::uint64_t flow(const TracePosition& position, std::int32_t row) const;
  Track lane(Lanes& lanes, Picoseconds begin, Picoseconds end);
  void wait(Track track, Picoseconds begin, Picoseconds end, StageActivity activity, PartId stream);
  PerfettoWriter out_;
  TraceParts parts_;
  std::array<std::vector<std::uint64_t>, 2> row_names_;  // numbers of "row 7" and "row 7 out"; 0: none yet
  std::vector<Track> stages_, ports_, fifo_counters_, rate_counters_, request_counters_;
  std::vector<Picoseconds> rate_until_;
  std::vector<Lanes> bursts_;
  Lanes frames_;
};

}  // namespace parallax
