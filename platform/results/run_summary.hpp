// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "traces/metrics.hpp"

namespace parallax {

/// The summary that a person reads, from the tree of measure() or measure_stuck().
std::string summary(const MetricGroup& metrics);

/// A line for each stage of the pipeline, where its cycles went, and for each stream, how full it was.
std::string stage_summary(const MetricGroup& metrics);

}  // namespace parallax
