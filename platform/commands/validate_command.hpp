// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace parallax {

struct CommandContext;

/// `parallax validate`: published figures beside what the model predicts (platform/validation).
void add_validate_command(CLI::App& app, CommandContext& context);

}  // namespace parallax
