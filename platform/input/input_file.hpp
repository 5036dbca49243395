// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace parallax {

/// All bytes of a file. Throws UserError when it cannot be read.
std::vector<std::uint8_t> read_file(const std::string& path);

}  // namespace parallax
