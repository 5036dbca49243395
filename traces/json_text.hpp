// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace parallax {

/// The text of a JSON tree; `indent`: blanks a level, -1 for one line. JSON is UTF-8, but names of files and
/// words of a command line are any bytes: what is no UTF-8 becomes U+FFFD, a question mark in a diamond.
template <class Json>
std::string json_text(const Json& tree, int indent = -1) {
  return tree.dump(indent, ' ', false, Json::error_handler_t::replace);
}

/// The same of a text that goes elsewhere, such as into a page.
inline std::string valid_utf8(std::string_view text) {
  const auto is_ascii = [](char c) { return static_cast<unsigned char>(c) < 0x80; };
  if (std::all_of(text.begin(), text.end(), is_ascii)) return std::string(text);
  return nlohmann::json::parse(json_text(nlohmann::json(text))).get<std::string>();
}

}  // namespace parallax
