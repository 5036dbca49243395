// SPDX-License-Identifier: Apache-2.0
#include "traces/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>

namespace parallax {
namespace {

constexpr int kLeastDigits = 3;   // from the first that is not 0
constexpr int kMostDigits = 7;    // with decimals
constexpr int kMostDecimals = 6;  // before a power of ten says it shorter
constexpr double kWritten = 1e12;

struct UnitDecimals {
  std::string_view unit;
  int decimals;
};
constexpr std::array<UnitDecimals, 15> kDecimals = {{{"%", 1},
                                                     {"MB/s", 1},
                                                     {"MB", 1},
                                                     {"mJ", 1},
                                                     {"Kibit", 1},
                                                     {"frames/s", 2},
                                                     {"W", 2},
                                                     {"s", 3},
                                                     {"ms", 3},
                                                     {"us", 3},
                                                     {"ns", 0},
                                                     {"px", 3},
                                                     {"s/s", 3},
                                                     {"1/s", 3},
                                                     {"", 4}}};

// What is in none of the rows is counted; that and pixels are mostly whole.
int decimals_of(std::string_view unit, double value) {
  const auto* const found = std::find_if(kDecimals.begin(), kDecimals.end(),
                                         [&](const UnitDecimals& row) { return row.unit == unit; });
  const bool counted = found == kDecimals.end();
  if ((counted || unit == "px") && value == std::floor(value)) return 0;
  return counted ? 1 : found->decimals;
}

std::string with_decimals(double value, int decimals) { return fmt::format("{:.{}f}", value, decimals); }

// Of a text such as "0.043": 2.
int significant_digits(const std::string& text) {
  const std::size_t first = text.find_first_of("123456789");
  if (first == std::string::npos) return 0;
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return static_cast<int>(
      std::count_if(text.begin() + static_cast<std::ptrdiff_t>(first), text.end(), is_digit));
}

bool says_too_little(const std::string& text, double value, std::string_view unit) {
  double said = 0;
  std::from_chars(text.data(), text.data() + text.size(), said);
  if (said == value) return false;
  return significant_digits(text) < kLeastDigits || (unit == "%" && value < 100 && said >= 100);
}

// Of a number from 0 on.
std::string positive_text(double value, std::string_view unit) {
  if (value >= kWritten) return fmt::format("{:.2e}", value);
  const int usual = decimals_of(unit, value);
  const std::string whole = with_decimals(value, 0);
  const int room = std::max(0, kMostDigits - static_cast<int>(whole.size()));
  std::string text = with_decimals(value, std::min(usual, room));
  for (int decimals = usual; says_too_little(text, value, unit); text = with_decimals(value, ++decimals)) {
    // So near to 100 % that only the computer's own roundings are between.
    if (decimals == kMostDecimals)
      return value < 1 ? fmt::format("{:.2e}", value) : with_decimals(value, usual);
  }
  return text;
}

// A number above 0 in what is counted in large pieces, and the word for them, after a blank; else as it is.
struct Scaled {
  double value;
  std::string word;
};
Scaled scaled(double value, std::string_view unit) {
  if (unit == "1/s" && value >= 1e9) return {value / 1e9, " billion"};
  if (unit == "1/s" && value >= 1e6) return {value / 1e6, " million"};
  if (unit == "1/s" && value >= 1e3) return {value / 1e3, " thousand"};
  return {value, ""};
}

}  // namespace

std::string number_text(double value, std::string_view unit) {
  if (!std::isfinite(value)) return fmt::format("{}", value);
  if (value < 0) return "-" + number_text(-value, unit);
  const Scaled number = scaled(value + 0.0, unit);  // never -0
  return positive_text(number.value, unit) + number.word;
}

std::string change_text(double value, std::string_view unit) {
  return (value > 0 ? "+" : "") + number_text(value, unit);
}

std::string stated_text(double value, std::string_view unit) {
  const Scaled number = scaled(value, unit);
  return fmt::format("{}{}", number.value, number.word);
}

std::string with_unit(const std::string& number, std::string_view unit) {
  if (unit.empty()) return number;
  if (unit == "1/s") return number + "/s";
  return fmt::format("{} {}", number, unit == "frames/s" ? "fps" : unit);
}

std::string quantity_text(double value, std::string_view unit) {
  return with_unit(number_text(value, unit), unit);
}

std::string grouped(std::string number) {
  const std::size_t begin = number.find_first_of("0123456789");
  if (begin == std::string::npos) return number;
  const std::size_t end = std::min(number.find_first_not_of("0123456789", begin), number.size());
  for (std::size_t at = end; at > begin + 3; at -= 3) number.insert(at - 3, ",");
  return number;
}

}  // namespace parallax
