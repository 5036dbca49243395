// SPDX-License-Identifier: Apache-2.0
#include "platform/config/config_value.hpp"

#include <fmt/format.h>

namespace parallax {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

struct TomlText {
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const {
    // The shortest text that reads back exactly; TOML tells a real from an integer by the point or the
    // exponent.
    std::string text = fmt::format("{}", value);
    if (text.find_first_of(".en") == std::string::npos) text += ".0";
    return text;
  }
  std::string operator()(const std::string& value) const { return quoted(value); }
};

}  // namespace

std::optional<Tag> tag_from_text(const std::string& text) {
  if (text.size() != 1 || std::string("SDIFC").find(text) == std::string::npos) return std::nullopt;
  return static_cast<Tag>(text[0]);
}

std::string to_toml(const ConfigValue& value) { return std::visit(TomlText{}, value); }

}  // namespace parallax
