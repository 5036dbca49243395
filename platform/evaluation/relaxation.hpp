// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "platform/config/machine_config.hpp"
#include "platform/machine/part.hpp"
#include "traces/metrics.hpp"

namespace parallax {

/// Limits of a machine taken away, as configuration keys: one, a single FIFO of many, or several together.
/// Part::relieved_by says which parts that makes faster.
struct Relaxation {
  std::string name;                      ///< "core_clock", "fifo_winners", "core_clock+host"
  std::string subject;                   ///< what limits, in a sentence: "core clock"
  std::string meaning;                   ///< a few words
  std::string remedy;                    ///< the same in a sentence: "... gives 143 fps"
  std::vector<std::string> assignments;  ///< "key=value"
  std::vector<Relief> limits;            ///< which; of a single FIFO Relief::kFifos
  std::vector<std::string> fifos{};      ///< of single FIFOs: their streams
  bool subject_is_plural = false;        ///< "buffers limit"
  bool remedy_is_plural = false;         ///< "deeper FIFOs give"

  bool is(Relief limit) const { return limits.size() == 1 && limits.front() == limit; }
};

/// Each limit alone: all that make sense for a machine; those that would change nothing are left out.
/// `metrics`: of its run, for the depths that its FIFOs have.
std::vector<Relaxation> relaxations(const MachineConfig& config, const MetricGroup& metrics);

/// Each FIFO alone, deep, the one that is full for longest first. One that never is holds nothing back,
/// unless others hand more to it. `full`: those only that are at times.
std::vector<Relaxation> fifo_relaxations(const MetricGroup& metrics, bool full);

/// Several FIFOs, each with so many tokens in place of those that it has. The two lists have one length.
Relaxation fifos_relaxation(const MetricGroup& metrics, const std::vector<std::string>& streams,
                            const std::vector<std::int64_t>& tokens);

/// The depth of a FIFO of `depth` tokens that fifo_relaxations() tries.
std::int64_t deep_enough(std::int64_t depth);

/// The FIFO of this stream with so many tokens in place of those that it has; 0: as many as the model
/// derives.
Relaxation fifo_relaxation(const MetricGroup& metrics, const std::string& stream, std::int64_t tokens);

/// Those of these FIFOs that have the depth of `streams.default_depth`, with another: together, by that key.
/// None where fewer than two have.
std::optional<Relaxation> default_depth_relaxation(const MachineConfig& config,
                                                   const std::vector<Relaxation>& fifos, std::int64_t tokens);

/// Depths to try for it: from twice what it has up to what fifo_relaxations() gives it, each twice the one
/// before; and 0 where the configuration says another than the model derives.
std::vector<std::int64_t> fifo_depths(const MachineConfig& config, const MetricGroup& metrics,
                                      const std::string& stream);

/// All of them at once; of two that set one key the one that takes more away.
Relaxation together(const std::vector<Relaxation>& some);

}  // namespace parallax
