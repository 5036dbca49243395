// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "platform/evaluation/relaxed_limits.hpp"
#include "platform/machine/machine.hpp"
#include "traces/metrics.hpp"

namespace parallax {

/// Evaluates the machine with each of these limits alone taken away, in their order.
using Trial = std::function<std::vector<EvaluationResult>(const std::vector<Relaxation>&)>;

/// How many limits are tried.
enum class Thoroughness {
  kUntilOneGains,  ///< that of the busiest part; if it gains nothing, all the others
  kAll,
};

/// What limits a machine, and what has shown it.
struct Verdict {
  std::string sentence;
  RelaxedLimits limits;  ///< those that were tried
};

/// `base`: of the machine as it is, done, with a frame rate.
Verdict find_verdict(const Machine& machine, const EvaluationResult& base, Thoroughness thoroughness,
                     const Trial& trial);

/// Adds it to the group "limit" of a run's metrics.
void add_verdict(MetricGroup& root, const Verdict& verdict);

}  // namespace parallax
