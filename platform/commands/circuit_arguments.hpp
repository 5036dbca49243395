// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "platform/input/circuit_options.hpp"

namespace CLI {
class App;
}

namespace parallax {

/// --circuit-top, --circuit-parameter, --circuit-include and --circuit-define: of Verilog that is built.
void add_circuit_build_options(CLI::App& command, CircuitOptions& circuit);

/// --circuit, once for each circuit in the place of a stage, and what belongs to it.
void add_circuit_options(CLI::App& command, std::vector<CircuitOptions>& circuits, bool& shadow);

}  // namespace parallax
