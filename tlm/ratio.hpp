// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace parallax {

/// Multiplies by numerator / denominator, exactly, without a division: 2^63 times the ratio's fractional part is
/// kept, rounded down, and gives a quotient that is right or short by a little, which a multiplication tells.
class Ratio {
 public:
  /// 0 < numerator, denominator < 2^63.
  constexpr Ratio(std::uint64_t numerator, std::uint64_t denominator)
      : whole_(numerator / denominator),
        rest_(numerator % denominator),
        denominator_(denominator),
        fraction_(static_cast<std::uint64_t>((Wide{rest_} << 63) / denominator)) {}

  /// `value` times the ratio, rounded down; the result must stay below 2^64.
  constexpr std::uint64_t floor(std::uint64_t value) const { return value * whole_ + quotient(value); }

  /// `value` times the ratio, rounded up; the result must stay below 2^64.
  constexpr std::uint64_t ceil(std::uint64_t value) const {
    const std::uint64_t fraction = quotient(value);
    const bool exact = Wide{fraction} * denominator_ == Wide{value} * rest_;
    return value * whole_ + fraction + (exact ? 0 : 1);
  }

 private:
  __extension__ using Wide = unsigned __int128;

  // value * rest_ / denominator_. fraction_ is short by less than 1, so the first quotient is short by less than
  // value / 2^63, and rounding takes at most one more: the loop runs three times at most.
  constexpr std::uint64_t quotient(std::uint64_t value) const {
    auto quotient = static_cast<std::uint64_t>((Wide{value} * fraction_) >> 63);
    while ((Wide{quotient} + 1) * denominator_ <= Wide{value} * rest_) ++quotient;
    return quotient;
  }

  std::uint64_t whole_;
  std::uint64_t rest_;
  std::uint64_t denominator_;
  std::uint64_t fraction_;  // rest_ / denominator_ in units of 2^-63
};

}  // namespace parallax
