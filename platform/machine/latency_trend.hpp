// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <systemc>
#include <vector>

namespace parallax {

/// Whether the latency of successive frames has a trend: while a queue between two parts of nearly the same
/// pace fills, each frame waits longer than the one before, for hundreds of frames. It has one where block
/// after block of frames it only rises, or only falls, by more than `tolerance` each. What remains after that
/// (phases of clocks, of the refresh, jitter) goes up and down.
class LatencyTrend {
 public:
  /// Frames that are looked at together.
  static constexpr std::size_t kBlock = 8;
  /// What is less is none: a share of the latency.
  static constexpr double kShare = 1e-4;

  /// `first`: number of the first frame after the warm-up. `tolerance`: at least so much is no trend either.
  LatencyTrend(std::size_t first, const sc_core::sc_time& tolerance) : first_(first), tolerance_(tolerance) {}

  /// Frame `frame` took so long; in order, from `first` on. True when the block that ends with it has a
  /// trend: the steady state begins after it at the earliest.
  bool add(std::size_t frame, const sc_core::sc_time& latency);
  /// The last frames, three or more, show none.
  bool settled() const { return block_.size() < 3 ? known_ && !rising_ : !has_trend(); }
  /// Three frames in a row have been seen.
  bool known() const { return known_; }
  /// Of the frames since the last block that had a trend, or of that block: s a frame; 0 when settled.
  double slope() const;

 private:
  bool has_trend() const;

  std::size_t first_;
  sc_core::sc_time tolerance_;
  std::vector<sc_core::sc_time> block_;
  bool known_ = false;
  bool rising_ = false;  // the last whole block had a trend
  double last_slope_ = 0;
};

}  // namespace parallax
