// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "platform/input/input_file.hpp"

namespace parallax {

/// The text of a file, unpacked when it is gzip (by content, not by name), without a byte order mark. Throws
/// UserError when it cannot be read, is damaged, or is larger than `largest` bytes when unpacked.
std::string read_text_file(const std::string& path, std::size_t largest = kMostFileBytes);

}  // namespace parallax
