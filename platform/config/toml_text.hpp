// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>

namespace parallax {

/// Throws UserError when a key of `text` has so many parts, a.b.c.d..., that who walks over what is parsed
/// would go too deep. Values within each other the parser counts itself. `origin` opens the message.
void check_toml_depth(const std::string& text, const std::string& origin);

/// Reads a TOML file. `what` names its kind in messages: "preset". Throws UserError with file and line.
toml::table read_toml(const std::filesystem::path& file, const std::string& what);

}  // namespace parallax
