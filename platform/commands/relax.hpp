// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/input/run_options.hpp"

namespace parallax {

struct CommandContext;

/// What limits the machine: its timing once as it is, then once for each limit with that limit alone taken
/// away (platform/evaluation/relaxation.hpp), and what that gains, largest first. Prints a table, or JSON;
/// with --out relaxations.json. Returns 0; 1 when the machine as it is cannot be measured; 128 + the signal
/// when interrupted.
int relax(const RunOptions& options, CommandContext& context);

}  // namespace parallax
