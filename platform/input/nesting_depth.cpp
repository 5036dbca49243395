// SPDX-License-Identifier: Apache-2.0
#include "platform/input/nesting_depth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "tlm/error.hpp"

namespace parallax {
namespace {

// What may be a comment, or a value in quotes, opens and does not close.
std::size_t depth_of_elements(std::string_view text) {
  std::size_t depth = 0, deepest = 0;
  bool comment = false;
  char quote = 0;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    const char c = text[i], next = text[i + 1];
    if (text.compare(i, 4, "<!--") == 0) comment = true;
    if (text.compare(i, 3, "-->") == 0) comment = false;
    if (c == '\n' || c == quote) {
      quote = 0;
    } else if (quote == 0 && (c == '"' || c == '\'')) {
      quote = c;
    }
    const bool closes = (c == '<' && next == '/') || (c == '/' && next == '>');
    if (closes && !comment && quote == 0 && depth > 0) --depth;
    const bool opens = c == '<' && (std::isalpha(static_cast<unsigned char>(next)) != 0 || next == '_');
    if (opens) deepest = std::max(deepest, ++depth);
  }
  return deepest;
}

// A step of indentation has one blank at least; in a line, what follows a colon or a dash may lie within it.
// A dash before a number is its sign. What may be a text in quotes, or the name of an entry with a quote in
// it, opens and does not close.
std::size_t depth_of_brackets(std::string_view text, bool is_json) {
  std::size_t brackets = 0, deepest = 0, blanks = 0, marks = 0;
  bool at_begin = true, comment = false;
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const char next = i + 1 < text.size() ? text[i + 1] : '\0';
    if (c == '\n') {
      at_begin = true;
      comment = false;
      blanks = marks = 0;
      quote = 0;
      continue;
    }
    if (at_begin && c == ' ') {
      ++blanks;
      continue;
    }
    comment = comment || (at_begin && c == '#');
    at_begin = false;
    if (comment) continue;
    if (c == '\\' && quote == '"') {
      ++i;
    } else if (c == quote) {
      quote = 0;
    } else if (quote == 0 && (c == '"' || c == '\'')) {
      quote = c;
    } else if (c == '[' || c == '{') {
      ++brackets;
    } else if (quote == 0 && (c == ']' || c == '}') && brackets > 0) {
      --brackets;
    } else if (!is_json && (c == ':' || (c == '-' && next != '.' &&
                                         std::isdigit(static_cast<unsigned char>(next)) == 0))) {
      ++marks;
    }
    deepest = std::max(deepest, brackets + blanks + marks);
  }
  return deepest;
}

}  // namespace

std::size_t nesting_depth(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  const char first = begin == std::string_view::npos ? '\0' : text[begin];
  return first == '<' ? depth_of_elements(text) : depth_of_brackets(text, first == '{');
}

void check_nesting(const std::string& text, const std::string& path) {
  // An indentation may be wide.
  constexpr std::size_t kDeepestNesting = 200;
  if (nesting_depth(text) > kDeepestNesting)
    throw UserError(
        fmt::format("{}: nested more than {} deep, such as no calibration or map is", path, kDeepestNesting));
}

}  // namespace parallax
