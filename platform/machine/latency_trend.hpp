// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <systemc>
#include <vector>

namespace parallax {

/// Whether the latency of successive frames has a trend: while a queue between two parts of nearly the same
/// pace fills, each frame waits longer than the one before, for hundreds of frames. It has one where block
/// after block of frames it rises all but steadily, or falls, by more than `tolerance` each. What remains
/// after that (phases of clocks, of the refresh, jitter) goes up and down; of four blocks and more it has a
/// trend, too, where their later half takes longer than the earlier one by more than such noise explains.
class LatencyTrend {
 public:
  static constexpr std::size_t kBlock = 8;
  /// How many frames tell whether there is one.
  struct Looks {
    std::size_t block;  ///< frames that are looked at together
    std::size_t least;  ///< of a block that is not whole yet: fewer say nothing
    double back;        ///< what may go the other way, as a share of the change
  };
  /// Where a trend ends within a block, what follows goes up and down a little.
  static constexpr Looks kAlike{kBlock, 3, 0.1};
  /// Where chance moves each latency: three would rise one time in three, twelve do once in 10^8 times.
  static constexpr Looks kByChance{12, 12, 0};
  /// Blocks without a trend after one that had one, before it is over: a queue may fill in steps.
  static constexpr std::size_t kCalm = 2;
  /// What is less is none: a share of the latency.
  static constexpr double kShare = 1e-4;
  /// Likewise between two halves of all blocks.
  static constexpr double kHalvesShare = 2.5e-3;

  /// `first`: number of the first frame after the warm-up. `tolerance`: at least so much is no trend either.
  LatencyTrend(std::size_t first, const sc_core::sc_time& tolerance, const Looks& looks = kAlike)
      : first_(first), tolerance_(tolerance), looks_(looks) {}

  /// Frame `frame` took so long; in order, from `first` on. True when the block that ends with it has a
  /// trend, or is the first one after it: the steady state begins after it at the earliest.
  bool add(std::size_t frame, const sc_core::sc_time& latency);
  /// The last frames, as many as it takes, show none, nor do all since the last block that had one.
  bool settled() const { return last_settled() && drift() == 0; }
  /// As many frames as it takes have been seen.
  bool known() const { return known_; }
  /// Of the frames since the last block that had a trend, or of that block: s a frame; 0 when settled.
  double slope() const;
  const sc_core::sc_time& tolerance() const { return tolerance_; }

 private:
  bool has_trend() const;
  bool last_settled() const {
    return calm_ >= kCalm && (block_.size() < looks_.least ? known_ : !has_trend());
  }
  void forget_means();
  void keep_mean();
  double drift() const;  // from half to half, s a frame; 0 where it is noise

  std::size_t first_;
  sc_core::sc_time tolerance_;
  Looks looks_;
  std::vector<sc_core::sc_time> block_;
  bool known_ = false;
  std::size_t calm_ = kCalm;  // blocks since one had a trend; many where none did
  double last_slope_ = 0;
  std::vector<double> means_;      // s, of the blocks since one had a trend
  std::size_t blocks_a_mean_ = 1;  // doubled when there are many
  double sum_ = 0;                 // of the means of blocks for the next of means_
  std::size_t summed_ = 0;
};

}  // namespace parallax
