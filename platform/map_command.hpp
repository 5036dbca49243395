// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>

namespace parallax {

/// Adds `map encode`, `map decode` and `map info` to the program. They run while the command line is parsed,
/// print to standard output and throw UserError.
void add_map_command(CLI::App& app);

}  // namespace parallax
