// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "platform/config/machine_config.hpp"
#include "platform/evaluation/trials.hpp"

namespace parallax {

/// The first FIFO of these that gains `enough` when it alone is deep; none if it takes several. They are
/// tried in halves: of those that do not gain enough together, none does alone. Throws TrialsEnded.
std::optional<RelaxedLimit> first_fifo(Trials& trials, const std::vector<Relaxation>& fifos, double enough);

/// The FIFO with the least depth of those to try (fifo_depths) with which it gains `enough`, by bisection
/// into three. `deep`: with a depth that is. Throws TrialsEnded.
RelaxedLimit shallowest(Trials& trials, const MachineConfig& config, const RelaxedLimit& deep, double enough);

/// Several FIFOs, which gain `enough` when each is `deep`: with twice, four times, ... the depth of each, the
/// least that is enough. Throws TrialsEnded.
RelaxedLimit shallowest_of_several(Trials& trials, const RelaxedLimit& deep, double enough);

/// The least `streams.default_depth` of twice, four times, ... what it is with which these FIFOs gain
/// `enough`; none if that takes more, or fewer than two of them have that depth. Throws TrialsEnded.
std::optional<RelaxedLimit> least_default_depth(Trials& trials, const MachineConfig& config,
                                                const std::vector<Relaxation>& fifos, double enough);

}  // namespace parallax
