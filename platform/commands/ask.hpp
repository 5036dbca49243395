// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "platform/input/run_options.hpp"

namespace parallax {

struct CommandContext;

/// What the user asked `parallax ask` for.
struct AskOptions {
  RunOptions run;                     ///< with `vary`: machines to choose from
  std::string which;                  ///< "least", "most" or "effect"
  std::vector<std::string> subjects;  ///< a key, or with `vary` a number; of an effect, "key=value" each
  std::vector<std::string> holds;     ///< "performance/frame_rate>=60"
  std::string device;                 ///< whose shares are numbers, too; empty: none
  std::optional<double> from, to;
};

/// Answers one of three questions, with the runs that show it. The least (or most) value of a key with which
/// a machine holds all bounds: with the next smaller (larger) one it does not. Of machines of a grid the one
/// with the least (or most) of a number that holds them. What a change of keys brings. Returns 0; 1 when
/// nothing holds the bounds; 128 + the signal when SIGINT or SIGTERM stopped it. Throws UserError.
int ask(const AskOptions& options, CommandContext& context);

}  // namespace parallax
