// SPDX-License-Identifier: Apache-2.0
#include "platform/input/quoted_text.hpp"

#include <algorithm>

namespace parallax {

std::string printable(std::string_view text) {
  constexpr std::size_t kLongest = 80;
  constexpr unsigned char kFirstPrintable = 0x20;
  constexpr unsigned char kDelete = 0x7f;
  std::string line(text.substr(0, kLongest));
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < kFirstPrintable || c == kDelete; }, '?');
  return text.size() > kLongest ? line + "..." : line;
}

std::string in_quotes(std::string_view text) { return "\"" + printable(text) + "\""; }

}  // namespace parallax
