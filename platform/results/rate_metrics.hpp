// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/machine/machine.hpp"
#include "platform/results/limits.hpp"
#include "traces/metric_table.hpp"

namespace parallax {

/// How many frames a second, how long a frame takes, and what limits: "performance", "latency", "limit".
void add_rates(MetricGroup& root, const Machine& machine, const SteadyWindow& window);

/// Whether more frames than there are would show nothing new (MachineInput::enough): it is steady, and not
/// only seems so as parts have nearly the same pace, so that a queue between them may fill for long; or a
/// queue fills so slowly that it would not be full within kMostFrames.
bool frames_are_enough(const Machine& machine);

/// These, and what a run without the limit adds to "limit".
const MetricTable& rate_table();

}  // namespace parallax
