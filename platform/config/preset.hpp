// SPDX-License-Identifier: Apache-2.0
// Presets by name: where they are looked for, what there is, and what one says after inheritance.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "platform/config/config_value.hpp"

namespace parallax {

/// Folders that are searched for `<name>.toml`, first match wins: those of the environment variable
/// PARALLAX_PRESET_PATH (separated by colons), `presets` beside the program, `../share/parallax/presets`. In
/// a shared library (the Python module) beside that, in the place of the program.
std::vector<std::filesystem::path> preset_folders();

/// Whether a preset's name is a path: it contains a slash or ends in ".toml".
bool is_preset_path(const std::string& name);

/// The file `<name>.toml` in the first folder that has it, or the path (is_preset_path) that it is. `what` is
/// what the file holds, for messages: "preset". Throws UserError: not found (says where it looked).
std::filesystem::path find_toml(const std::string& name, const std::vector<std::filesystem::path>& folders,
                                const std::string& what);

/// The values of a preset, by name or path, and of all that it inherits from; `what` as in find_toml().
/// Throws UserError: not found (says where it looked), unreadable, malformed, a cycle of `inherits`.
RawConfig load_preset(const std::string& name, const std::vector<std::filesystem::path>& folders,
                      const std::string& what = "preset");

struct PresetSummary {
  std::string name;
  std::string description;
};

/// All presets in the folders, by name; one that is hidden by an earlier folder is left out.
std::vector<PresetSummary> list_presets(const std::vector<std::filesystem::path>& folders);

}  // namespace parallax
