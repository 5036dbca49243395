// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace parallax {

struct CommandContext;

/// parallax compare: what a simulator wrote down of a circuit, beside the vectors of a stage.
void add_compare_command(CLI::App& app, CommandContext& context);

}  // namespace parallax
