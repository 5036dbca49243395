// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "platform/evaluation/relaxed_limits.hpp"
#include "traces/metrics.hpp"

namespace parallax {

/// What limits, in one sentence. `base`: timing.json of the machine as it is. `part`: that of its parts which
/// is at work all the time; null where there is none.
std::string verdict(const nlohmann::ordered_json& base, const Part* part, const RelaxedLimits& limits);

/// Adds to the group "limit" of a run's metrics what taking limits away has shown.
void add_verdict(MetricGroup& root, const std::string& sentence, const RelaxedLimits& limits);

}  // namespace parallax
