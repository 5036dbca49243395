// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "platform/evaluation/relaxed_limits.hpp"
#include "platform/evaluation/trials.hpp"
#include "traces/metrics.hpp"

namespace parallax {

/// How many limits are tried alone.
enum class Thoroughness {
  kUntilCertain,  ///< those of the busiest part; others where they may gain more (AloneSearch)
  kAll,
};

/// What limits a machine, and what has shown it.
struct Verdict {
  std::string sentence;
  RelaxedLimits limits;  ///< those that were tried
  bool complete = true;  ///< false: no more trials were made, and what was found so far is named
};

/// What gains most when it alone is taken away; of FIFOs which one, and what depth is enough; where nothing
/// gains alone, the fewest that gain together. `base`: of the machine as it is, done, with a frame rate. When
/// `trial` gives fewer results than asked for, what was found so far.
Verdict find_verdict(const MachineConfig& config, const EvaluationResult& base, Thoroughness thoroughness,
                     const Trial& trial);

/// Adds it to the group "limit" of a run's metrics.
void add_verdict(MetricGroup& root, const Verdict& verdict);

}  // namespace parallax
