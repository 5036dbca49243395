// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "tlm/units.hpp"

namespace parallax {

/// How full a FIFO was, for how long: cycles of the writer's clock at each fill level. A FIFO of up to 64
/// tokens has a bin for each level; a deeper one has bins of equal width, a power of two. Counted from cycle
/// 0 until the last date at which the level is known.
class Occupancy {
 public:
  static constexpr std::size_t kMaxBins = 65;

  /// `depth`: tokens that the FIFO holds, >= 1.
  explicit Occupancy(std::uint32_t depth) : depth_(depth) {
    while ((depth >> shift_) >= kMaxBins) ++shift_;
  }

  void add(std::uint64_t level, std::uint64_t cycles) {
    cycles_[level >> shift_] += cycles;
    level_cycles_ += level * cycles;
    if (level == 0) empty_ += cycles;
    if (level == depth_) full_ += cycles;
  }

  std::size_t bins() const { return (depth_ >> shift_) + 1; }
  /// Levels in a bin: bin i holds the levels [i * bin_width(), (i + 1) * bin_width()).
  std::uint64_t bin_width() const { return std::uint64_t{1} << shift_; }
  std::uint64_t cycles(std::size_t bin) const { return cycles_[bin]; }
  std::uint64_t empty() const { return empty_; }  ///< cycles with no token
  std::uint64_t full() const { return full_; }    ///< cycles without a free slot
  /// Tokens held, summed over the cycles.
  std::uint64_t level_cycles() const { return level_cycles_; }
  /// Cycles in all: the sum over all bins.
  std::uint64_t total() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t bin : cycles_) sum += bin;
    return sum;
  }
  /// Tokens held, on average over total(); 0 before anything happened.
  double mean() const { return quotient(level_cycles_, total()); }

 private:
  std::uint64_t depth_;
  unsigned shift_ = 0;
  std::array<std::uint64_t, kMaxBins> cycles_{};
  std::uint64_t level_cycles_ = 0;
  std::uint64_t empty_ = 0;
  std::uint64_t full_ = 0;
};

}  // namespace parallax
