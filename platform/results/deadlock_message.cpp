// SPDX-License-Identifier: Apache-2.0
#include "platform/results/deadlock_message.hpp"

namespace parallax {

std::string deadlock_message(const Machine& machine) {
  const std::vector<Wait> circle = machine.dataflow().deadlock();
  if (circle.empty()) {
    return "the machine stopped before the host had all frames; these wait:\n" +
           describe(machine.dataflow().waits());
  }
  return "the machine is deadlocked; nobody in this circle can go on:\n" + describe(circle);
}

}  // namespace parallax
