// SPDX-License-Identifier: Apache-2.0
// How a number is printed, written from the definition in traces/number_text.hpp on the digits of the exact
// decimal expansion.
#pragma once

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>

namespace parallax::test {

/// The digits of a number >= 0 before and after the point, all of them: a double has no more than 1074
/// decimals.
struct Expansion {
  explicit Expansion(double value) {
    static char text[1500];
    std::snprintf(text, sizeof text, "%.1080f", value);
    const std::string all = text;
    whole = all.substr(0, all.find('.'));
    decimals = all.substr(all.find('.') + 1);
  }

  bool is_whole() const { return decimals.find_first_not_of('0') == std::string::npos; }
  /// Whether so many decimals are all that there are.
  bool ends_after(int count) const { return decimals.find_first_not_of('0', count) == std::string::npos; }

  /// Rounded to so many decimals by adding to the last digit by hand; the even neighbour of two that are as
  /// near.
  std::string rounded(int count) const {
    std::string digits = whole + decimals.substr(0, count);
    const std::string rest = decimals.substr(count);
    const std::string half = "5" + std::string(rest.size() - 1, '0');
    const bool up = rest > half || (rest == half && (digits.back() - '0') % 2 == 1);
    std::size_t at = digits.size();
    bool carry = up;
    while (carry && at > 0) {
      --at;
      carry = digits[at] == '9';
      digits[at] = carry ? '0' : static_cast<char>(digits[at] + 1);
    }
    if (carry) digits.insert(0, "1");
    const std::size_t point = digits.size() - count;
    return digits.substr(0, point) + (count == 0 ? "" : "." + digits.substr(point));
  }

  std::string whole;
  std::string decimals;
};

/// Digits from the first that is not 0.
inline int digits_that_count(const std::string& text) {
  int count = 0;
  for (const char c : text) count += c != '.' && (count > 0 || c != '0') ? 1 : 0;
  return count;
}

inline std::string with_power_of_ten(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2e", value);
  return text;
}

/// "100.26" of 100.2604 frames/s.
inline std::string naive_number_text(double value, const std::string& unit) {
  if (value < 0) return "-" + naive_number_text(-value, unit);
  if (unit == "1/s") {
    if (value >= 1e9) return naive_number_text(value / 1e9, "s") + " billion";
    if (value >= 1e6) return naive_number_text(value / 1e6, "s") + " million";
    if (value >= 1e3) return naive_number_text(value / 1e3, "s") + " thousand";
  }
  if (value >= 1e12) return with_power_of_ten(value);
  static const std::map<std::string, int> usual_decimals{
      {"%", 1},  {"MB/s", 1}, {"MB", 1}, {"mJ", 1}, {"Kibit", 1}, {"frames/s", 2}, {"W", 2}, {"s", 3},
      {"ms", 3}, {"us", 3},   {"ns", 0}, {"px", 3}, {"s/s", 3},   {"1/s", 3},      {"", 4}};
  const Expansion exact(value);
  const auto known = usual_decimals.find(unit);
  const bool counted = known == usual_decimals.end();
  const int usual = exact.is_whole() && (counted || unit == "px") ? 0 : counted ? 1 : known->second;
  const int room = 7 - static_cast<int>(exact.rounded(0).size());
  if (room < usual) return exact.rounded(std::max(0, room));
  for (int count = usual; count <= 6; ++count) {
    const std::string text = exact.rounded(count);
    const bool reads_100 = unit == "%" && value < 100 && text.substr(0, 3) == "100";
    // The double nearest to what is printed may be the number itself: 9.8 is "9.8".
    if (std::stod(text) == value || (digits_that_count(text) >= 3 && !reads_100)) return text;
  }
  return value < 1 ? with_power_of_ten(value) : exact.rounded(usual);
}

/// Its thousands apart.
inline std::string naive_grouped(const std::string& text) {
  const std::size_t end = std::min(text.find_first_not_of("-0123456789"), text.size());
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (i > 0 && i < end && (end - i) % 3 == 0 && text[i - 1] != '-') result += ',';
    result += text[i];
  }
  return result;
}

}  // namespace parallax::test
