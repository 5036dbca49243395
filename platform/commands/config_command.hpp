// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace parallax {

struct CommandContext;

/// `parallax config`: prints the effective configuration, its documentation, or the presets there are.
void add_config_command(CLI::App& app, CommandContext& context);

}  // namespace parallax
