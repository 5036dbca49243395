// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace parallax {

struct CommandContext;

/// `parallax ask`.
void add_ask_command(CLI::App& app, CommandContext& context);

}  // namespace parallax
