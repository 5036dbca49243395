// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <string>
#include <vector>

namespace parallax {

/// "file.toml:12".
std::string toml_origin(const std::string& file, const toml::node& node);

/// A node of a TOML file that knows where it stands, for messages. Whatever asks it for something that it is
/// not throws UserError.
struct TomlPart {
  std::string file;
  std::string name;  ///< key, or path of keys
  const toml::node* node = nullptr;
  std::string section{};  ///< name of the part that it was found in

  std::string origin() const { return toml_origin(file, *node); }
  /// Throws UserError "file:line: name: why".
  [[noreturn]] void fail(const std::string& why) const;

  std::vector<TomlPart> entries() const;  ///< of a table
  /// Of a table and those within it, with paths as names; a table that says what a value is, or its bounds,
  /// is a leaf.
  std::vector<TomlPart> leaves() const;
  std::vector<TomlPart> elements() const;  ///< of an array
  std::string text() const;
  double number() const;                                            ///< finite
  std::int64_t whole(std::int64_t least, std::int64_t most) const;  ///< integer within these
  std::string value() const;                ///< of a boolean, number or text, as an assignment has it
  std::vector<std::string> values() const;  ///< of one, or of an array of them
};

}  // namespace parallax
