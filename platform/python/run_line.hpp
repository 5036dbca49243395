// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "platform/commands/command_line.hpp"
#include "platform/input/run_options.hpp"

namespace parallax {

/// What the words behind `parallax run` ask for. Throws UserError, with the line that the program prints, for
/// words that it refuses, and for what one process does not do for another: a sweep, help, circuits.
std::shared_ptr<RunOptions> run_options(const std::vector<std::string>& words);

/// The line that does the same.
CommandLine run_line(const std::vector<std::string>& words);

}  // namespace parallax
