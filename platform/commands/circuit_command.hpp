// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace parallax {

struct CommandContext;

/// parallax circuit: a library of Verilog sources, for run --circuit.
void add_circuit_command(CLI::App& app, CommandContext& context);

}  // namespace parallax
