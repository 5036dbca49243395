// SPDX-License-Identifier: Apache-2.0
#include "platform/input/nesting_depth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "tlm/error.hpp"

namespace parallax {
namespace {

std::size_t depth_of_elements(std::string_view text) {
  std::size_t depth = 0, deepest = 0;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    const bool closes = (text[i] == '<' && text[i + 1] == '/') || (text[i] == '/' && text[i + 1] == '>');
    if (closes && depth > 0) --depth;
    const bool opens =
        text[i] == '<' && (std::isalpha(static_cast<unsigned char>(text[i + 1])) != 0 || text[i + 1] == '_');
    if (opens) deepest = std::max(deepest, ++depth);
  }
  return deepest;
}

// A step of indentation has one blank at least.
std::size_t depth_of_brackets(std::string_view text) {
  std::size_t depth = 0, deepest = 0, blanks = 0;
  bool at_begin = true;
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') {
      at_begin = true;
      blanks = 0;
      quote = 0;  // a text that goes on in the next line is counted as if it were none: too deep rather than
                  // not deep enough
    } else if (at_begin && c == ' ') {
      ++blanks;
    } else {
      if (at_begin) deepest = std::max(deepest, blanks);
      at_begin = false;
      if (quote != 0) {
        if (c == '\\' && quote == '"') {
          ++i;
        } else if (c == quote) {
          quote = 0;
        }
      } else if (c == '"' || c == '\'') {
        quote = c;
      } else if (c == '[' || c == '{') {
        deepest = std::max(deepest, ++depth);
      } else if ((c == ']' || c == '}') && depth > 0) {
        --depth;
      }
    }
  }
  return deepest;
}

}  // namespace

std::size_t nesting_depth(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  const bool is_xml = begin != std::string_view::npos && text[begin] == '<';
  return is_xml ? depth_of_elements(text) : depth_of_brackets(text);
}

void check_nesting(const std::string& text, const std::string& path) {
  // An indentation may be wide.
  constexpr std::size_t kDeepest = 200;
  if (nesting_depth(text) > kDeepest)
    throw UserError(
        fmt::format("{}: nested more than {} deep, such as no calibration or map is", path, kDeepest));
}

}  // namespace parallax
