// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/input/run_options.hpp"

namespace parallax {

struct CommandContext;

/// A timing-only run for every combination of the values of --vary: a line of a table for each, or a JSON
/// array, and point_0000/timing.json and so on in --out; with --relax what limits at each, and
/// point_0000/relaxations.json. Returns 0; 1 when a point could not be measured (its row says why);
/// 128 + the signal when SIGINT or SIGTERM stopped it, the finished points being there. Throws UserError,
/// before the first point, when --vary is malformed or names an unknown key.
int vary(const RunOptions& options, CommandContext& context);

}  // namespace parallax
