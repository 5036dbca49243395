// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "platform/config/machine_config.hpp"
#include "platform/machine/part.hpp"
#include "traces/metrics.hpp"

namespace parallax {

/// One limit of a machine taken away, as configuration keys. Part::relieved_by says which parts that makes
/// faster.
struct Relaxation {
  Relief limit;
  std::string meaning;                   ///< a few words
  std::string remedy;                    ///< the same in a sentence: "... gives 143 fps"
  std::vector<std::string> assignments;  ///< "key=value"

  /// "core_clock".
  std::string name() const { return name_of(limit); }
};

/// All that make sense for a machine: those that would change nothing are left out. `metrics`: of its
/// run, for the depths that its FIFOs have.
std::vector<Relaxation> relaxations(const MachineConfig& config, const MetricGroup& metrics);

}  // namespace parallax
