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
  static constexpr std::size_t kBlock = 8;
  /// How many frames tell whether there is one.
  struct Looks {
    std::size_t block;  ///< frames that are looked at together
    std::size_t least;  ///< of a block that is not whole yet: fewer say nothing
  };
  static constexpr Looks kAlike{kBlock, 3};
  /// Where chance moves each latency: three would rise one time in three, twelve do once in 10^8 times.
  static constexpr Looks kByChance{12, 12};
  /// What is less is none: a share of the latency.
  static constexpr double kShare = 1e-4;

  /// `first`: number of the first frame after the warm-up. `tolerance`: at least so much is no trend either.
  LatencyTrend(std::size_t first, const sc_core::sc_time& tolerance, const Looks& looks = kAlike)
      : first_(first), tolerance_(tolerance), looks_(looks) {}

  /// Frame `frame` took so long; in order, from `first` on. True when the block that ends with it has a
  /// trend: the steady state begins after it at the earliest.
  bool add(std::size_t frame, const sc_core::sc_time& latency);
  /// The last frames, as many as it takes, show none.
  bool settled() const { return block_.size() < looks_.least ? known_ && !rising_ : !has_trend(); }
  /// As many frames as it takes have been seen.
  bool known() const { return known_; }
  /// Of the frames since the last block that had a trend, or of that block: s a frame; 0 when settled.
  double slope() const;

 private:
  bool has_trend() const;

  std::size_t first_;
  sc_core::sc_time tolerance_;
  Looks looks_;
  std::vector<sc_core::sc_time> block_;
  bool known_ = false;
  bool rising_ = false;  // the last whole block had a trend
  double last_slope_ = 0;
};

}  // namespace parallax
