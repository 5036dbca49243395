// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace parallax {

/// Writes a whole file so that it is either complete or not there: under a temporary name in the same folder,
/// then renamed. A path that names something other than a regular file (a pipe, a device) is written
/// directly. Throws UserError, and leaves nothing behind, when the folder cannot be written or the disk is
/// full.
void write_file(const std::string& path, const std::uint8_t* bytes, std::size_t size);

/// Throws UserError when the file cannot be read.
std::vector<std::uint8_t> read_file(const std::string& path);

}  // namespace parallax
