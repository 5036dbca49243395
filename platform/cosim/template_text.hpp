// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace parallax {

using Replacements = std::vector<std::pair<std::string, std::string>>;

/// A template, each of whose words in @...@ is replaced by the text that belongs to it, in this order.
inline std::string filled(std::string text, const Replacements& words) {
  for (const auto& [name, value] : words) {
    const std::string key = "@" + name + "@";
    for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + value.size()))
      text.replace(at, key.size(), value);
  }
  return text;
}

}  // namespace parallax
