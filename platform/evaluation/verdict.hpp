// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "platform/evaluation/relaxed_limits.hpp"
#include "traces/metrics.hpp"

namespace parallax {

/// Evaluates the machine with each of these taken away, in their order. Fewer results: it was interrupted.
using Trial = std::function<std::vector<EvaluationResult>(const std::vector<Relaxation>&)>;

/// How many limits are tried alone.
enum class Thoroughness {
  kUntilCertain,  ///< those of the busiest part; the others where all of them together gain more
  kAll,
};

/// What limits a machine, and what has shown it.
struct Verdict {
  std::string sentence;
  RelaxedLimits limits;  ///< those that were tried
};

/// What gains most when it alone is taken away; of FIFOs which one, and what depth is enough; where nothing
/// gains alone, the fewest that gain together. Some fifteen evaluations at most, and as many FIFOs as are
/// ever full where these limit. `base`: of the machine as it is, done, with a frame rate. When interrupted,
/// what was found so far.
Verdict find_verdict(const MachineConfig& config, const EvaluationResult& base, Thoroughness thoroughness,
                     const Trial& trial);

/// Adds it to the group "limit" of a run's metrics.
void add_verdict(MetricGroup& root, const Verdict& verdict);

}  // namespace parallax
