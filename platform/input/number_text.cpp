// SPDX-License-Identifier: Apache-2.0
#include "platform/input/number_text.hpp"

#include <charconv>
#include <limits>
#include <string>

namespace parallax {

std::optional<double> number_of(std::string_view text) {
  const bool negative = !text.empty() && text.front() == '-';
  if (negative || (!text.empty() && text.front() == '+')) text.remove_prefix(1);
  if (text == ".nan" || text == ".NaN" || text == ".NAN") return std::numeric_limits<double>::quiet_NaN();
  double value = std::numeric_limits<double>::infinity();
  if (text != ".inf" && text != ".Inf" && text != ".INF") {
    // Two signs in a row are none of a number.
    if (text.empty() || text.front() == '-') return std::nullopt;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::invalid_argument || end != text.data() + text.size()) return std::nullopt;
    // Too large or too small for a double; the latter is as good as zero.
    if (error == std::errc::result_out_of_range) {
      const bool small = text.find("e-") != text.npos || text.find("E-") != text.npos;
      value = small ? 0 : std::numeric_limits<double>::infinity();
    }
  }
  return negative ? -value : value;
}

}  // namespace parallax
