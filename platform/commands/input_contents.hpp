// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "platform/input/run_options.hpp"

namespace parallax {

/// A checksum of each file that these options name (of a folder, of what is in it and when it was written):
/// another text when a result of before is none of these files.
std::string input_contents(const RunOptions& options);

}  // namespace parallax
