// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/value_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr std::int64_t kLargest = 100'000'000'000'000'000;  // 10^17: sums and differences fit
constexpr int kMostExponent = 400;

/// mantissa * 10^exponent.
struct Decimal {
  std::int64_t mantissa = 0;
  int exponent = 0;
  std::optional<int> written;  ///< the exponent that it is written with, "125e6"
};

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

// None when it is no number, or one of too many digits.
std::optional<Decimal> decimal_of(const std::string& text) {
  Decimal number;
  std::size_t at = 0;
  const bool negative = text[0] == '-';
  if (negative || text[0] == '+') ++at;
  bool digits = false;
  bool point = false;
  for (; at < text.size() && (is_digit(text[at]) || (text[at] == '.' && !point)); ++at) {
    if (text[at] == '.') {
      point = true;
      continue;
    }
    digits = true;
    number.mantissa = 10 * number.mantissa + (text[at] - '0');
    if (number.mantissa >= kLargest) return std::nullopt;
    if (point) --number.exponent;
  }
  if (!digits) return std::nullopt;
  if (at < text.size()) {
    if (text[at] != 'e' && text[at] != 'E') return std::nullopt;
    const std::string power = text.substr(at + 1);
    const std::size_t first = !power.empty() && (power[0] == '-' || power[0] == '+') ? 1 : 0;
    if (power.size() == first || power.size() > first + 3 ||
        !std::all_of(power.begin() + static_cast<std::ptrdiff_t>(first), power.end(), is_digit))
      return std::nullopt;
    number.written = std::atoi(power.c_str());
    if (std::abs(*number.written) > kMostExponent) return std::nullopt;
    number.exponent += *number.written;
  }
  if (negative) number.mantissa = -number.mantissa;
  return number;
}

// The mantissa with this exponent, which is no larger than the number's.
std::optional<std::int64_t> scaled(const Decimal& number, int exponent) {
  std::int64_t mantissa = number.mantissa;
  for (int i = exponent; i < number.exponent && mantissa != 0; ++i) {
    mantissa *= 10;
    if (std::abs(mantissa) >= kLargest) return std::nullopt;
  }
  return mantissa;
}

// mantissa * 10^exponent without a power of ten; exponent at most 0.
std::string plain(std::int64_t mantissa, int exponent) {
  std::string digits = std::to_string(std::abs(mantissa));
  const auto after_point = static_cast<std::size_t>(-exponent);
  if (digits.size() <= after_point) digits.insert(0, after_point + 1 - digits.size(), '0');
  if (after_point > 0) digits.insert(digits.size() - after_point, ".");
  return (mantissa < 0 ? "-" : "") + digits;
}

}  // namespace

std::vector<std::string> range_values(const std::string& text, std::size_t most) {
  const std::string quoted = excerpt(text);
  std::array<Decimal, 3> numbers;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::size_t colon = text.find(':', begin);
    const std::string part = text.substr(begin, colon - begin);
    const std::optional<Decimal> number = part.empty() ? std::nullopt : decimal_of(part);
    if (!number || (colon == std::string::npos) != (i == 2)) {
      throw UserError(fmt::format(
          "'{}' is no range: it must have the form start:stop:step, three numbers such as 10:100:5", quoted));
    }
    numbers[i] = *number;
    begin = colon + 1;
  }
  const int exponent = std::min({numbers[0].exponent, numbers[1].exponent, numbers[2].exponent});
  std::array<std::int64_t, 3> mantissas{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::optional<std::int64_t> mantissa = scaled(numbers[i], exponent);
    if (!mantissa) throw UserError(fmt::format("the numbers of '{}' differ by too many digits", quoted));
    mantissas[i] = *mantissa;
  }
  const auto [start, stop, step] = mantissas;
  if (step == 0) throw UserError(fmt::format("the step of '{}' is 0", quoted));
  if (start != stop && (stop > start) != (step > 0)) {
    throw UserError(fmt::format("'{}' never comes to its end: the step must be {}", quoted,
                                stop > start ? "positive" : "negative"));
  }
  const std::int64_t steps = (stop - start) / step;
  if (steps >= static_cast<std::int64_t>(most))
    throw UserError(fmt::format("'{}' has more than {} values", quoted, most));
  const bool powers = numbers[0].written && numbers[0].written == numbers[1].written &&
                      numbers[0].written == numbers[2].written;
  const int power = powers ? *numbers[0].written : std::max(exponent, 0);
  std::vector<std::string> values;
  for (std::int64_t i = 0; i <= steps; ++i) {
    values.push_back(plain(start + i * step, exponent - power));
    if (power != 0) values.back() += fmt::format("e{}", power);
  }
  return values;
}

}  // namespace parallax
