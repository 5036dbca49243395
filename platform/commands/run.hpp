// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/input/run_options.hpp"

namespace parallax {

struct CommandContext;

/// Runs the machine on the input. Returns 0; 1 when the machine got stuck (the cycle of waits is printed);
/// 128 + the signal when SIGINT or SIGTERM stopped it, the finished frames of a sequence being intact. Throws
/// UserError for bad input: then nothing is half written, and of a sequence there are the frames before the
/// fault.
int run(const RunOptions& options, CommandContext& context);

}  // namespace parallax
