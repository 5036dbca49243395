// SPDX-License-Identifier: Apache-2.0
// The work that every mechanism of the chain benchmarks does: tokens from a source through 8 stages into a
// sink.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace parallax::bench {

inline constexpr int kStages = 8;

/// Tokens through `kStages` stages of interval 1 and latency 1, with a registered FIFO before and after each.
struct ChainLoad {
  /// Cycles that the source (sink) takes from one token to the next, each at least 1; the last is followed by
  /// the first again.
  std::vector<std::uint32_t> source_gaps{1};
  std::vector<std::uint32_t> sink_gaps{1};
  std::uint32_t depth = 2;   ///< of every FIFO, >= 1
  std::uint64_t frames = 1;  ///< how often the source goes through its gaps

  std::uint64_t tokens() const { return frames * source_gaps.size(); }
};

/// Goes through gaps one by one, without end.
class Gaps {
 public:
  explicit Gaps(const std::vector<std::uint32_t>& gaps) : gaps_(gaps) {}
  std::int64_t next() {
    const std::uint32_t gap = gaps_[at_];
    if (++at_ == gaps_.size()) at_ = 0;
    return gap;
  }

 private:
  const std::vector<std::uint32_t>& gaps_;
  std::size_t at_ = 0;
};

/// What a mechanism returns.
struct ChainRun {
  double seconds = 0;          ///< processor time of the simulation, without building it
  std::int64_t last_read = 0;  ///< cycle in which the sink reads the last token
};

/// No stage waits but at the start: a token a cycle.
inline ChainLoad regular_load(std::uint32_t depth, std::uint64_t frames) {
  const std::vector<std::uint32_t> gaps(4093, 1);
  return {gaps, gaps, depth, frames};
}

/// Source and sink rest for 1 to 6 more cycles after every fourth token on average, independently, so that
/// FIFOs run full and empty. The lengths of the two sequences are prime: their sum does not come again for 16
/// million tokens.
inline ChainLoad stalling_load(std::uint32_t depth, std::uint64_t frames) {
  std::mt19937 random(1);
  const auto draw = [&](std::size_t count) {
    std::vector<std::uint32_t> gaps(count);
    for (std::uint32_t& gap : gaps)
      gap = random() % 4 == 0 ? static_cast<std::uint32_t>(2 + random() % 6) : 1;
    return gaps;
  };
  ChainLoad load;
  load.source_gaps = draw(4093);
  load.sink_gaps = draw(4099);
  load.depth = depth;
  load.frames = frames;
  return load;
}

}  // namespace parallax::bench
