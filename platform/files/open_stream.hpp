// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace parallax {

/// A descriptor of what is read once, from its beginning to its end: a file, a pipe, a device. -1 with errno
/// when it cannot be opened. Throws UserError when it is a pipe into which nobody writes, for a second.
int open_stream(const std::string& path);

}  // namespace parallax
