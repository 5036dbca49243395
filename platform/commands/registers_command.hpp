// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace parallax {

struct CommandContext;

/// `parallax registers`: prints the core's register map as text, Markdown or a C header.
void add_registers_command(CLI::App& app, CommandContext& context);

}  // namespace parallax
