// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/candidates.hpp"

#include <fmt/format.h>

#include <cmath>

namespace parallax {
namespace {

// Three digits and a power of ten, which is written as one of a thousand where it can be: 146 and 7 are
// "1460e6".
std::string text_of(int digits, int exponent) {
  if (exponent < 0) return fmt::format("{}e{}", digits, exponent);
  const int zeros = exponent % 3;
  return fmt::format("{}{:0>{}}", digits, "", zeros) +
         (exponent < 3 ? "" : fmt::format("e{}", exponent - zeros));
}

}  // namespace

std::vector<std::string> candidates(double least, double most, bool whole) {
  constexpr int kFirst = 100;  // of the numbers of three digits
  constexpr int kLast = 999;
  std::vector<std::string> all;
  if (whole) {
    for (int number = 1; number < kFirst; ++number) {
      if (number >= least && number <= most) all.push_back(fmt::format("{}", number));
    }
  }
  const int lowest = whole ? 0 : static_cast<int>(std::floor(std::log10(least))) - 2;
  for (int exponent = lowest; kFirst * std::pow(10.0, exponent) <= most; ++exponent) {
    for (int digits = kFirst; digits <= kLast; ++digits) {
      // As the text is read back, so that both ends are met.
      const std::string text = text_of(digits, exponent);
      const double number = std::stod(text);
      if (number >= least && number <= most) all.push_back(text);
    }
  }
  return all;
}

}  // namespace parallax
