// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "platform/cosim/circuit/circuit.h"

namespace parallax {

/// The pins of a circuit's top module.
struct PinList {
  std::string name;  ///< of the circuit
  std::vector<parallax_pin> pins;
};

}  // namespace parallax
