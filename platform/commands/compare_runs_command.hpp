// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace parallax {

struct CommandContext;

/// `parallax compare-runs A B`: what changed in the configuration and in the results.
void add_compare_runs_command(CLI::App& app, CommandContext& context);

}  // namespace parallax
