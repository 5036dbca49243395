// SPDX-License-Identifier: Apache-2.0
// Reads one preset file (TOML) into the raw layer. Nothing is checked against the schema here.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "platform/config/config_value.hpp"

namespace parallax {

struct PresetFile {
  std::filesystem::path path;
  std::string description;              ///< one line for the list of presets
  std::optional<std::string> inherits;  ///< name or path of the preset that this one starts from
  std::string inherits_origin;          ///< "file:line" of `inherits`
  RawConfig values;
};

/// Throws UserError with file and line when the file cannot be read or is not a well-formed preset; messages
/// call it a `what`.
PresetFile read_preset_file(const std::filesystem::path& path, const std::string& what = "preset");

/// Takes a command-line argument "key=value" apart. The value is written as in a preset; the quotes of a name
/// may be left out. Throws UserError naming the argument.
std::pair<std::string, RawValue> read_assignment(const std::string& argument);

}  // namespace parallax
