// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/evaluation/relaxation.hpp"
#include "traces/metrics.hpp"

namespace parallax {

/// What taking this away gains at most, %, as the metrics of the run without it say: no more frames than the
/// time holds of a part's work, where the part works for each frame as long as before. Infinite where no such
/// part was at work.
double most_gain(const Relaxation& relaxation, const MetricGroup& metrics);

}  // namespace parallax
