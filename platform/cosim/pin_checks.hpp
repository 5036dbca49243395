// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "platform/cosim/circuit_pins.hpp"
#include "platform/cosim/pin_list.hpp"
#include "platform/cosim/vector_manifest.hpp"
#include "platform/input/circuit_options.hpp"

namespace parallax {

/// Whether pins and options go together: a handshake has a clock, a latency no valid at the outputs, and a
/// gap something that tells the circuit of it. Throws UserError.
void check_pins(const PinList& circuit, const CircuitPins& pins, const VectorManifest& stage,
                const CircuitOptions& options);

/// Where some ports of a direction have valid (ready) and others none: what the user may have meant to be one
/// for all, a line each.
std::vector<std::string> half_handshakes(const CircuitPins& pins);

}  // namespace parallax
