// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "modules/pixel.hpp"
#include "tlm/stream.hpp"

namespace parallax {

/// A block in kernel time: copies a disparity every third cycle of its clock.
class SlowCopy final : public sc_core::sc_module {
 public:
  StreamIn<Disparity> in_disparity{"in_disparity"};
  StreamOut<Disparity> out_disparity{"out_disparity"};

  SlowCopy(const sc_core::sc_module_name& name, const ClockDomain& clock) : sc_module(name), clock_(clock) {
    SC_HAS_PROCESS(SlowCopy);
    SC_THREAD(run);
  }

 private:
  void run() {
    for (;;) {
      const Disparity value = in_disparity->read();  // waits for a token
      clock_.wait_until(clock_.now() + Cycles(2));   // an RTL model would be clocked here
      out_disparity->write(value);                   // waits for room
      clock_.wait_until(clock_.now() + Cycles(1));
    }
  }

  const ClockDomain& clock_;
};

}  // namespace parallax
