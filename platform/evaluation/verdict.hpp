// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
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
  /// Where a limit is named that costs cycles of the core's own, as a FIFO does: a faster core, which gains
  /// more as it shortens these too.
  std::optional<RelaxedLimit> faster_clock;
  /// Where one FIFO is named: all of them deeper, if that gains more.
  std::optional<RelaxedLimit> all_fifos;
  bool complete = true;  ///< false: no more trials were made, and what was found so far is named
};

/// What gains most when it alone is taken away. A faster core gains in proportion whatever its cycles are
/// lost to: where another limit costs a part of these, that one is named. Of FIFOs the one that gains all
/// that deeper ones do, or most of it, and what depth is enough; or the default depth that is; or the fewest.
/// Where nothing gains alone, the fewest that gain together. `base`: of the machine as it is, done, with a
/// frame rate. When `trial` gives fewer results than asked for, what was found so far.
Verdict find_verdict(const MachineConfig& config, const EvaluationResult& base, Thoroughness thoroughness,
                     const Trial& trial);

/// Adds it to the group "limit" of a run's metrics.
void add_verdict(MetricGroup& root, const Verdict& verdict);

}  // namespace parallax
