// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>

namespace parallax {

/// Reads a TOML file. `what` names its kind in messages: "preset". Throws UserError with file and line.
toml::table read_toml(const std::filesystem::path& file, const std::string& what);

}  // namespace parallax
