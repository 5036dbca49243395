// SPDX-License-Identifier: Apache-2.0
#include "platform/input/nesting_depth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "platform/input/opencv_yaml.hpp"
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

// What may be a text in quotes opens and does not close.
std::size_t depth_of_brackets(std::string_view text) {
  std::size_t depth = 0, deepest = 0;
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n' || c == quote) {
      quote = 0;
    } else if (c == '\\' && quote == '"') {
      ++i;
    } else if (quote == 0 && (c == '"' || c == '\'')) {
      quote = c;
    } else if (c == '[' || c == '{') {
      deepest = std::max(deepest, ++depth);
    } else if (quote == 0 && (c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
  return deepest;
}

}  // namespace

std::size_t nesting_depth(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  const char first = begin == std::string_view::npos ? '\0' : text[begin];
  if (first == '<') return depth_of_elements(text);
  return first == '{' ? depth_of_brackets(text) : look_at_opencv_yaml(text).depth;
}

void check_nesting(const std::string& text, const std::string& path) {
  constexpr std::size_t kDeepestNesting = 200;
  if (nesting_depth(text) > kDeepestNesting)
    throw UserError(
        fmt::format("{}: nested more than {} deep, such as no calibration or map is", path, kDeepestNesting));
}

}  // namespace parallax
