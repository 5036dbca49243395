// SPDX-License-Identifier: Apache-2.0
#include "tlm/error.hpp"

namespace parallax {

std::string excerpt(std::string_view text, std::size_t most) {
  std::string shown(text.substr(0, most));
  if (shown.size() < text.size()) {
    // A character of UTF-8 is not cut: bytes 10xxxxxx follow its first one.
    while (!shown.empty() && (static_cast<unsigned char>(text[shown.size()]) & 0xC0U) == 0x80U)
      shown.pop_back();
    shown += "...";
  }
  for (char& c : shown) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  }
  return shown;
}

}  // namespace parallax
