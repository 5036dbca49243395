// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/results/limits.hpp"
#include "traces/metric_table.hpp"

namespace parallax {

/// The memory as a whole, and each of its ports: bytes, bandwidth, share, latency, stalls.
void add_memory(MetricGroup& root, const Machine& machine, const SteadyWindow& window);
const MetricTable& memory_table();

}  // namespace parallax
