// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>

namespace parallax {

/// Stalls of one side of a handshake, each cycle at random.
class Stalls {
 public:
  static constexpr std::uint64_t kMost = 999;  ///< of 1000 cycles

  /// `per_thousand`: of 1000 cycles, those that are stalled, 0 to kMost. The same seed gives the same stalls.
  Stalls(std::uint64_t per_thousand, std::uint64_t seed) : per_thousand_(per_thousand), random_(seed) {}
  /// From the next cycle on.
  void set(std::uint64_t per_thousand) { per_thousand_ = per_thousand; }
  bool next() { return per_thousand_ != 0 && random_() % 1000 < per_thousand_; }

 private:
  std::uint64_t per_thousand_;
  std::mt19937_64 random_;
};

}  // namespace parallax
