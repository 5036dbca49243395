// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "platform/config/machine_config.hpp"
#include "traces/metrics.hpp"

namespace parallax {

/// Of the files that a run writes: files of the same version can be read and compared by any program that
/// writes this version. It goes up by one when a name or a unit that there was is gone, means something else,
/// or moves; not when one is added.
constexpr std::int64_t kResultSchema = 1;

/// Adds the group "schema": that version, and the hash of the configuration (configuration_hash).
void add_schema(MetricGroup& root, const MachineConfig& config);

}  // namespace parallax
