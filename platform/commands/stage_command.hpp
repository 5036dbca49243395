// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace parallax {

struct CommandContext;

/// parallax stage: what a stage makes of tokens, which come on standard input.
void add_stage_command(CLI::App& app, CommandContext& context);

}  // namespace parallax
