// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <ostream>

#include "platform/commands/command_line.hpp"

namespace parallax {

enum class Verbosity { kQuiet, kNormal, kVerbose };

/// What the command line hands to a command. A command registers its options and, when it is the one that was
/// called, sets `action`; the frame runs it once the whole line has been read without fault.
struct CommandContext {
  std::ostream& out;  ///< results
  std::ostream& err;  ///< messages
  CommandLine command_line;
  Verbosity verbosity = Verbosity::kNormal;
  bool progress = true;           ///< may be shown on `err`
  std::function<int()> action{};  ///< returns the exit code (exit_codes.hpp); throws UserError for bad input
};

/// Whether standard error shows how far a command is: at a terminal, unless told to be quiet.
bool shows_progress(const CommandContext& context);

}  // namespace parallax
