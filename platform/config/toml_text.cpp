// SPDX-License-Identifier: Apache-2.0
#include "platform/config/toml_text.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "tlm/error.hpp"

namespace parallax {
namespace {

std::string one_line(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  return text;
}

std::string content_of(const std::filesystem::path& file, const std::string& what) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  if (std::filesystem::is_directory(file)) {
    throw UserError(fmt::format("{}: is a folder, not a {} file", file.string(), what));
  }
  if (!stream)
    throw UserError(fmt::format("{}: cannot read the {}: {}", file.string(), what, std::strerror(errno)));
  content << stream.rdbuf();
  return content.str();
}

}  // namespace

toml::table read_toml(const std::filesystem::path& file, const std::string& what) {
  try {
    return toml::parse(content_of(file, what));
  } catch (const toml::parse_error& error) {
    throw UserError(fmt::format("{}:{}: {}", file.string(), error.source().begin.line,
                                one_line(std::string(error.description()))));
  }
}

}  // namespace parallax
