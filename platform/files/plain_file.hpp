// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace parallax {

/// Throws UserError when something other than a file, or a link to one, is at the path: a folder, or a pipe,
/// a device or a socket, from which it may take forever to read, and which is empty when it is read again.
/// What is not there passes: opening it says so. `expected`: as the message ends.
void require_plain_file(const std::string& path, const std::string& expected = "a file");

}  // namespace parallax
