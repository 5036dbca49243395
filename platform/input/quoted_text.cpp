// SPDX-License-Identifier: Apache-2.0
#include "platform/input/quoted_text.hpp"

#include "tlm/error.hpp"

namespace parallax {

std::string in_quotes(std::string_view text) { return "\"" + excerpt(text) + "\""; }

std::string shell_word(const std::string& word) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + '\'';
}

}  // namespace parallax
