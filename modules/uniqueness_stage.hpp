// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "modules/cost_check_stage.hpp"
#include "modules/uniqueness.hpp"

namespace parallax {

/// Uniqueness check, without look-ahead (paper, "Uniqueness Check").
using UniquenessStage = CostCheckStage<Uniqueness, UniquenessConfig>;

}  // namespace parallax
