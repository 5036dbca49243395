// SPDX-License-Identifier: Apache-2.0
// The effective configuration as text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "platform/config/configuration.hpp"

namespace parallax {

/// A preset that gives the same configuration when it is read back. With `documented`, each key carries its
/// tag and source, and a comment with its documentation and range.
std::string to_toml(const Configuration& configuration, bool documented);

/// The same as a tree: section, then key; a key holds its value or, with `documented`, an object of value,
/// unit, allowed values, documentation, tag and source.
nlohmann::ordered_json to_json(const Configuration& configuration, bool documented);

}  // namespace parallax
