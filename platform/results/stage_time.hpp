// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "platform/results/limits.hpp"
#include "tlm/stage.hpp"

namespace parallax {

/// Where a stage's cycles went for the window's frames: from a stage's first firing for one frame to that for
/// another; of the whole run when the window holds no frame.
StageStatistics stage_time(const StageInfo& info, const SteadyWindow& window);

/// The parts (>= 0) as shares of their sum, in units of which `whole` make it, rounded so that they sum to
/// exactly that: those with the largest remainders are rounded up, of equal ones the first. All 0 if the sum
/// is.
std::vector<std::int64_t> shares_of(const std::vector<std::int64_t>& parts, std::int64_t whole);

/// In tenths of a percent.
inline std::vector<std::int64_t> shares_in_tenths(const std::vector<std::int64_t>& parts) {
  return shares_of(parts, 1000);
}

}  // namespace parallax
