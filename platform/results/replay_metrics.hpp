// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tlm/dram_replay.hpp"
#include "traces/metric_table.hpp"

namespace parallax {

/// What `parallax memory` says of an address trace.
MetricGroup measure(const ReplayResult& result, const DramTiming& timing);
const MetricTable& replay_table();

}  // namespace parallax
