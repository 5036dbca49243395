// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "modules/consistency.hpp"
#include "modules/cost_check_stage.hpp"

namespace parallax {

/// Consistency check: a disparity leaves when its right pixel has seen all its candidates, the disparity
/// range later (paper, "Consistency Check").
using ConsistencyStage = CostCheckStage<Consistency, ConsistencyConfig>;

}  // namespace parallax
