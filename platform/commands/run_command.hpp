// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace parallax {

struct CommandContext;

/// `parallax run`: stereo pairs through the whole machine; writes disparity maps and `timing.json`, prints a
/// summary.
void add_run_command(CLI::App& app, CommandContext& context);

}  // namespace parallax
