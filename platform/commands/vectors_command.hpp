// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace parallax {

struct CommandContext;

/// parallax vectors: what goes in and out of a stage, for the test bench of a circuit.
void add_vectors_command(CLI::App& app, CommandContext& context);

}  // namespace parallax
