// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace parallax {

/// part / whole as real numbers, of counts as of measures; 0 where the whole is 0.
template <class Part, class Whole>
constexpr double quotient(Part part, Whole whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// The number of an enumerator, counted from 0 as in an array with an element for each.
template <class Enum>
constexpr std::size_t index_of(Enum enumerator) {
  return static_cast<std::size_t>(enumerator);
}

/// An integer with a unit: two quantities of different units neither add nor compare.
template <class Tag>
class Quantity {
 public:
  using Rep = std::int64_t;

  constexpr Quantity() = default;
  template <class Int, class = std::enable_if_t<std::is_integral_v<Int>>>
  explicit constexpr Quantity(Int count) : count_(static_cast<Rep>(count)) {}

  constexpr Rep count() const { return count_; }
  /// The count as a size or an index; it must not be negative.
  constexpr std::size_t size() const { return static_cast<std::size_t>(count_); }
  /// The count as a number to divide and to average.
  constexpr double real() const { return static_cast<double>(count_); }

  constexpr Quantity& operator+=(Quantity o) { return count_ += o.count_, *this; }
  constexpr Quantity& operator-=(Quantity o) { return count_ -= o.count_, *this; }
  friend constexpr Quantity operator+(Quantity a, Quantity b) { return a += b; }
  friend constexpr Quantity operator-(Quantity a, Quantity b) { return a -= b; }
  template <class Int, class = std::enable_if_t<std::is_integral_v<Int>>>
  friend constexpr Quantity operator*(Quantity a, Int n) {
    return Quantity(a.count_ * static_cast<Rep>(n));
  }
  friend constexpr bool operator==(Quantity a, Quantity b) { return a.count_ == b.count_; }
  friend constexpr bool operator!=(Quantity a, Quantity b) { return a.count_ != b.count_; }
  friend constexpr bool operator<(Quantity a, Quantity b) { return a.count_ < b.count_; }
  friend constexpr bool operator<=(Quantity a, Quantity b) { return a.count_ <= b.count_; }
  friend constexpr bool operator>(Quantity a, Quantity b) { return a.count_ > b.count_; }
  friend constexpr bool operator>=(Quantity a, Quantity b) { return a.count_ >= b.count_; }

 private:
  Rep count_ = 0;
};

/// A number or a date in cycles of one clock domain. Which domain is said by whoever hands it out.
using Cycles = Quantity<struct CyclesTag>;
using Bytes = Quantity<struct BytesTag>;
using Bits = Quantity<struct BitsTag>;

/// A date or duration in kernel time, at the kernel's resolution of a picosecond.
using Picoseconds = Quantity<struct PicosecondsTag>;

/// A clock frequency, exact.
using Hertz = Quantity<struct HertzTag>;

}  // namespace parallax
