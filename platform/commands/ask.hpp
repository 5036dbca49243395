// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "platform/input/run_options.hpp"

namespace parallax {

struct CommandContext;

/// What the user asked `parallax ask` for.
struct AskOptions {
  RunOptions run;
  std::string key;
  std::string which;  ///< "least" or "most": the value that is looked for
  std::string hold;   ///< "performance/frame_rate>=60"
  std::optional<double> from, to;
};

/// The least (or largest) value of a key with which a machine holds a bound, and the runs that show it: with
/// it the bound holds, with the next smaller (larger) one it does not. Returns 0; 1 when no value holds it;
/// 128 + the signal when SIGINT or SIGTERM stopped it. Throws UserError.
int ask(const AskOptions& options, CommandContext& context);

}  // namespace parallax
