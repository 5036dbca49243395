// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/run_options.hpp"

namespace parallax {

struct CommandContext;

/// Runs the machine on the input. Returns 0, or 1 when the machine got stuck (the cycle of waits is printed).
/// Throws UserError for bad input; then nothing is half written.
int run(const RunOptions& options, CommandContext& context);

}  // namespace parallax
