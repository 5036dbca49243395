// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "modules/map_codec.hpp"

namespace parallax {

/// The map appears complete or not at all; throws UserError when it cannot be written.
void write_map_file(const std::string& path, const EncodedMap& map);

/// Throws UserError when the file cannot be read, is truncated or corrupt.
EncodedMap read_map_file(const std::string& path);

}  // namespace parallax
