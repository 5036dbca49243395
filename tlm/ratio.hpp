// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace parallax {

/// Multiplies by numerator / denominator, exactly and without a division: by 2^63 times the ratio's
/// fractional part, rounded down. The error is below value / 2^63; only where that leaves the result open is
/// it multiplied out.
class Ratio {
 public:
  /// 0 < numerator, denominator < 2^63.
  constexpr Ratio(std::uint64_t numerator, std::uint64_t denominator)
      : whole_(numerator / denominator),
        rest_(numerator % denominator),
        denominator_(denominator),
        fraction_(static_cast<std::uint64_t>((Wide{rest_} << 63) / denominator)) {}

  /// `value` < 2^63 times the ratio, rounded down; the result must stay below 2^64.
  constexpr std::uint64_t floor(std::uint64_t value) const {
    const Wide product = Wide{value} * fraction_;
    const auto quotient = static_cast<std::uint64_t>(product >> 63);
    if (below_point(product) + value < kOne) return value * whole_ + quotient;
    return value * whole_ + exact_quotient(value, quotient);
  }

  /// `value` < 2^63 times the ratio, rounded up; the result must stay below 2^64.
  constexpr std::uint64_t ceil(std::uint64_t value) const {
    const Wide product = Wide{value} * fraction_;
    auto quotient = static_cast<std::uint64_t>(product >> 63);
    const std::uint64_t below = below_point(product);
    if (below != 0 && below + value < kOne) return value * whole_ + quotient + 1;
    quotient = exact_quotient(value, quotient);
    const bool rounded = Wide{quotient} * denominator_ != Wide{value} * rest_;
    return value * whole_ + quotient + (rounded ? 1 : 0);
  }

 private:
  __extension__ using Wide = unsigned __int128;

  static constexpr std::uint64_t kOne = std::uint64_t{1} << 63;
  static constexpr std::uint64_t below_point(Wide product) {
    return static_cast<std::uint64_t>(product) & (kOne - 1);
  }

  // value * rest_ / denominator_, from a quotient that may be one too small.
  constexpr std::uint64_t exact_quotient(std::uint64_t value, std::uint64_t quotient) const {
    return quotient + ((Wide{quotient} + 1) * denominator_ <= Wide{value} * rest_ ? 1 : 0);
  }

  std::uint64_t whole_;
  std::uint64_t rest_;
  std::uint64_t denominator_;
  std::uint64_t fraction_;  // rest_ / denominator_ in units of 2^-63
};

}  // namespace parallax
