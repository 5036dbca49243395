// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "platform/cosim/circuit_library.hpp"
#include "platform/cosim/circuit_port.hpp"
#include "tlm/units.hpp"

namespace parallax {

/// Whether an output's valid waits for ready, so that both sides may wait for ever: AXI4-Stream forbids it,
/// and of an output with its names it is a breach. Where outputs are not ready and offer nothing, ready is
/// set to 1 and back within the cycle, so that only what hangs together without a register is found, and that
/// for certain.
class ReadyProbe {
 public:
  /// Of outputs that pass together. Both must outlive it.
  ReadyProbe(Circuit& circuit, const std::vector<CircuitOutput*>& outputs)
      : circuit_(circuit), outputs_(outputs) {}

  /// After evaluation, before the edge. Then all pins are as they were.
  void look(Cycles cycle);
  /// Of an output whose names are not those of AXI4-Stream; empty: none.
  const std::string& note() const { return note_; }

 private:
  Circuit& circuit_;
  const std::vector<CircuitOutput*>& outputs_;
  int left_ = 1000;  // looks
  std::string note_;
};

}  // namespace parallax
