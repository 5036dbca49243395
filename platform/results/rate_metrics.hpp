// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/machine/machine.hpp"
#include "platform/results/limits.hpp"
#include "traces/metric_table.hpp"

namespace parallax {

/// How many frames a second, how long a frame takes, and what limits: "performance", "latency", "limit".
void add_rates(MetricGroup& root, const Machine& machine, const SteadyWindow& window);

/// These, and what a run without the limit adds to "limit".
const MetricTable& rate_table();

}  // namespace parallax
