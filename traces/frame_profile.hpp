// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "traces/trace_sink.hpp"

namespace parallax {

/// What passed each memory port during the last whole period of a run, from one frame's arrival at the host
/// until the next one's; and one port row by row, during the last whole frame of it. Its size does not grow
/// with the run.
class FrameProfile final : public TraceSink {
 public:
  /// `by_row`: name of the port that is looked at row by row.
  explicit FrameProfile(std::string by_row) : by_row_(std::move(by_row)) {}

  void begin(const TraceParts& parts) override { parts_ = parts; }
  void port_row(const PortRow& row) override;
  void frame_step(std::int64_t frame, FrameStep step, Picoseconds time) override;

  /// {"period", "bin" (ps), "bandwidth": {port: [MB/s in each bin]}, "rows": {port: {"bytes": [...],
  /// "latency_mean": [ps], "latency_longest": [ps]}}}; null before two frames are at the host.
  nlohmann::ordered_json to_json() const;

 private:
  TraceParts parts_;
  std::vector<PortRow> rows_;  // since the last arrival
  std::vector<PortRow> last_;  // of the period before
  const std::string by_row_;
  std::vector<PortRow> frame_;        // of that port, of the frame under way
  std::vector<PortRow> whole_frame_;  // the one before
  Picoseconds begin_{-1};
  Picoseconds end_{-1};
};

}  // namespace parallax
