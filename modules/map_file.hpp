// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "modules/map_codec.hpp"

namespace parallax {

/// The bytes of a map file (MAP_FORMAT.md): header, row lengths, rows.
std::vector<std::uint8_t> to_file_bytes(const EncodedMap& map);

/// Checks lengths, sums and the checksum of everything; throws UserError, its line begins with `name`. The
/// rows are not decoded.
EncodedMap from_file_bytes(const std::vector<std::uint8_t>& bytes, const std::string& name);

}  // namespace parallax
