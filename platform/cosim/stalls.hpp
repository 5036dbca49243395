// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>

namespace parallax {

/// Stalls of one side of a handshake, each cycle at random.
class Stalls {
 public:
  /// `per_thousand`: of 1000 cycles, those that are stalled, 0 to 999. The same seed gives the same stalls.
  Stalls(std::uint64_t per_thousand, std::uint64_t seed) : per_thousand_(per_thousand), random_(seed) {}
  bool next() { return per_thousand_ != 0 && random_() % 1000 < per_thousand_; }

 private:
  std::uint64_t per_thousand_;
  std::mt19937_64 random_;
};

}  // namespace parallax
