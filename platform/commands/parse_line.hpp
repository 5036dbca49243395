// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ostream>

namespace CLI {
class App;
}

namespace parallax {

/// Reads a command line. Throws UserError with one line, or returns true when help or version was asked for
/// and printed.
bool parse_line(CLI::App& app, int argc, const char* const* argv, std::ostream& out);

}  // namespace parallax
