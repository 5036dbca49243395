// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/input/circuit_options.hpp"

namespace CLI {
class App;
}

namespace parallax {

/// --circuit-top and --circuit-parameter: of Verilog that is built.
void add_circuit_build_options(CLI::App& command, CircuitOptions& options);

/// --circuit and what belongs to it: a circuit in the place of a stage.
void add_circuit_options(CLI::App& command, CircuitOptions& options);

}  // namespace parallax
