// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace parallax {

/// The text of a file, unpacked when it is gzip (by content, not by name), without a byte order mark. Throws
/// UserError when it cannot be read, is damaged, or unpacks to more than 1 GiB.
std::string read_text_file(const std::string& path);

}  // namespace parallax
