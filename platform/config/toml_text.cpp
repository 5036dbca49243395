// SPDX-License-Identifier: Apache-2.0
#include "platform/config/toml_text.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "platform/files/article.hpp"
#include "platform/files/plain_file.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr std::size_t kMostBytes = 16 << 20;

std::string content_of(const std::filesystem::path& file, const std::string& what) {
  require_plain_file(file.string(), with_article(what) + " file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw UserError(fmt::format("{}: cannot read the {}: {}", file.string(), what, std::strerror(errno)));
  std::string content;
  // Piece by piece: a buffer for the largest file would take thousands of pages at each start of the program.
  for (std::array<char, 1 << 14> piece; stream && content.size() <= kMostBytes;) {
    stream.read(piece.data(), piece.size());
    content.append(piece.data(), static_cast<std::size_t>(stream.gcount()));
  }
  if (content.size() > kMostBytes) {
    throw UserError(fmt::format("{}: has more than {} MiB, too much for {} file", file.string(),
                                kMostBytes >> 20, with_article(what)));
  }
  return content;
}

/// How many parts the dotted key has that begins here, as in a.b."c d"; 0 for none. `at` ends behind it.
std::size_t key_parts(const std::string& text, std::size_t& at) {
  const auto blanks = [&] {
    while (at < text.size() && (text[at] == ' ' || text[at] == '\t')) ++at;
  };
  for (std::size_t parts = 0;; ++parts) {
    const std::size_t begin = at;
    if (at < text.size() && (text[at] == '"' || text[at] == '\'')) {
      const std::size_t end = text.find(text[at], at + 1);
      if (end == std::string::npos) return parts;
      at = end + 1;
    } else {
      while (at < text.size() &&
             (std::isalnum(static_cast<unsigned char>(text[at])) != 0 || text[at] == '_' || text[at] == '-'))
        ++at;
    }
    if (at == begin) return parts;
    blanks();
    if (at >= text.size() || text[at] != '.') return parts + 1;
    ++at;
    blanks();
  }
}

}  // namespace

void check_toml_depth(const std::string& text, const std::string& origin) {
  constexpr std::size_t kMostParts = 64;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = at;
    if (key_parts(text, at) > kMostParts) {
      throw UserError(fmt::format("{}: {}: a key of more than {} parts, such as no key has", origin,
                                  excerpt(text.substr(begin, at - begin)), kMostParts));
    }
    if (at == begin) ++at;
  }
}

toml::table read_toml(const std::filesystem::path& file, const std::string& what) {
  const std::string content = content_of(file, what);
  check_toml_depth(content, file.string());
  try {
    return toml::parse(content);
  } catch (const toml::parse_error& error) {
    throw UserError(fmt::format("{}:{}: {}", file.string(), error.source().begin.line,
                                excerpt(error.description(), 200)));
  }
}

}  // namespace parallax
