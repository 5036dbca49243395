// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/ready_probe.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "platform/cosim/signal_bits.hpp"

namespace parallax {

void ReadyProbe::look(Cycles cycle) {
  const auto set_ready = [this](bool ready) {
    for (const CircuitOutput* output : outputs_) output->port().pins.ready.set(ready ? 1 : 0);
    circuit_.evaluate();
  };
  const bool could_wait = std::all_of(outputs_.begin(), outputs_.end(), [](const CircuitOutput* output) {
    const PortPins& pins = output->port().pins;
    return pins.valid && pins.ready && !output->ready() && !pins.valid.any();
  });
  if (left_ == 0 || !could_wait) return;
  --left_;
  set_ready(true);
  CircuitOutput* waits = nullptr;
  for (CircuitOutput* output : outputs_) {
    if (output->port().pins.valid.any()) waits = output;
  }
  set_ready(false);
  if (waits == nullptr) return;
  left_ = 0;
  const PortPins& pins = waits->port().pins;
  const std::string what =
      fmt::format("{}: {} waits for {}, and is 0 or 1 as it is, in cycle {}", waits->port().stream.name,
                  pins.valid.name(), pins.ready.name(), cycle.count());
  if (ends_with(pins.valid.pin().name, "tvalid")) {
    waits->breaks(what + "; AXI4-Stream forbids it");
  } else {
    note_ = what + "; AXI4-Stream forbids it, as both sides may wait for ever";
  }
}

}  // namespace parallax
