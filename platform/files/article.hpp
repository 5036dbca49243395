// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace parallax {

/// "an image", "a preset": the words with their article.
inline std::string with_article(const std::string& what) {
  const bool vowel = std::string_view("aeiou").find(what.front()) != std::string_view::npos;
  return (vowel ? "an " : "a ") + what;
}

}  // namespace parallax
