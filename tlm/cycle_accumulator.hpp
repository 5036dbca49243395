// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tlm/units.hpp"

namespace parallax {

/// Cycles that work takes at `per_unit` = numerator / denominator cycles a unit, without ever losing a
/// fraction: the sum over any number of calls is the exact time rounded down. numerator * units must stay
/// below 2^63.
class CycleAccumulator {
 public:
  CycleAccumulator(std::int64_t numerator, std::int64_t denominator)
      : numerator_(numerator), denominator_(denominator) {}

  Cycles take(std::int64_t units) {
    const std::int64_t exact = units * numerator_ + remainder_;
    remainder_ = exact % denominator_;
    return Cycles(exact / denominator_);
  }

 private:
  std::int64_t numerator_;
  std::int64_t denominator_;
  std::int64_t remainder_ = 0;
};

}  // namespace parallax
