// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iosfwd>
#include <string>

namespace CLI {
class App;
}

namespace parallax {

struct CommandContext;

/// All commands with their options.
void add_commands(CLI::App& app, CommandContext& context);

/// Whatever a message holds, one line that a terminal shows, and that is not endless.
std::string one_line(const std::string& text);

/// The command line. Returns the exit code: 0 done and within budget; 1 the model ran and a check or budget
/// failed; 2 bad input or configuration; 3 a fault of the program itself; 128 + the signal's number
/// when the run was interrupted (130 for Ctrl-C). 2 and 3 come with one line on standard error.
int run_command_line(int argc, const char* const* argv);

/// The same with other streams in place of standard output and standard error.
int run_command_line(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace parallax
