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
  std::function<int()> action{};  ///< returns the exit code; throws UserError for bad input
};

}  // namespace parallax
