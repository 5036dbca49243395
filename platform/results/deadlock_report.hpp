// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "platform/machine/machine.hpp"
#include "tlm/deadlock.hpp"
#include "traces/metric_table.hpp"

namespace parallax {

/// Why a machine stopped before the host had all frames.
struct Deadlock {
  std::vector<Wait> circle;  ///< of waits, each for the next one; empty: none is known
  std::vector<Wait> waits;   ///< all
  std::string ends;          ///< where chains of them end (describe_ends), if there is no circle
  Remedy remedy;             ///< of a circle
};

/// After a simulation that ended so. Finding the remedy takes seconds for large images.
Deadlock find_deadlock(const Machine& machine);

/// Several lines: who waits on whom, and the depth that would free them.
std::string message(const Deadlock& deadlock);

/// The group "deadlock": the remedy, and each wait of the circle (or, where none is known, each wait).
void add_deadlock(MetricGroup& root, const Deadlock& deadlock);
const MetricTable& deadlock_table();

}  // namespace parallax
