// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "tlm/units.hpp"
#include "traces/text_buffer.hpp"

namespace parallax {

/// Dates as decimal numbers. Those that follow one another share their upper digits, which are kept.
class DateText {
 public:
  /// Appends to `at`, where kDigits fit, and returns where that ends.
  char* put(char* at, Picoseconds date) {
    const std::int64_t value = date.count();
    if (value < kLower) return parallax::put(at, value);
    const std::int64_t upper = value / kLower;
    if (upper != upper_) {
      upper_ = upper;
      digits_ = parallax::put(text_.data(), upper) - text_.data();
    }
    std::memcpy(at, text_.data(), text_.size());  // of one size, as that is faster
    at += digits_;
    const auto lower = static_cast<std::uint32_t>(value - upper * kLower);
    put_pair(at, lower / 10'000);
    put_pair(at + 2, lower / 100 % 100);
    put_pair(at + 4, lower % 100);
    return at + 6;
  }

 private:
  static constexpr std::int64_t kLower = 1'000'000;

  static void put_pair(char* at, std::uint32_t number) {
    at[0] = static_cast<char>('0' + number / 10);
    at[1] = static_cast<char>('0' + number % 10);
  }

  std::int64_t upper_ = -1;
  std::size_t digits_ = 0;  // of it
  std::array<char, 16> text_{};
};

}  // namespace parallax
