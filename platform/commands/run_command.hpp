// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "platform/input/run_options.hpp"

namespace CLI {
class App;
}

namespace parallax {

struct CommandContext;

/// The options of `parallax run`, for a line that calls no command; read when `command` has parsed it.
std::shared_ptr<RunOptions> add_run_options(CLI::App& command);

/// `parallax run`: stereo pairs through the whole machine; writes disparity maps and `timing.json`, prints a
/// summary.
void add_run_command(CLI::App& app, CommandContext& context);

}  // namespace parallax
