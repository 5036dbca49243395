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

}  // namespace parallax
