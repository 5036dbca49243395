// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/results/limits.hpp"
#include "traces/metric_table.hpp"

namespace parallax {

/// Stages, where their cycles went, and streams, how full they were; and the buffers in memory. Of the whole
/// run when the window holds no frame.
void add_pipeline(MetricGroup& root, const Machine& machine, const SteadyWindow& window);
const MetricTable& pipeline_table();

}  // namespace parallax
