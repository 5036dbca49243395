// SPDX-License-Identifier: Apache-2.0
// The consistency check as consistency.hpp defines it, on a whole volume.
#pragma once

#include <cstdlib>

#include "modules/consistency.hpp"
#include "tests/modules/images.hpp"
#include "tests/modules/naive_uniqueness.hpp"

namespace parallax::test {

/// d_r of right pixel u; -1 if no left pixel sees it.
inline int naive_right_disparity(const ConsistencyConfig& config, DisparityRange range,
                                 const Grid<Cost>& costs, int u, int y) {
  int best = -1;
  for (int k = 0; k < costs.depth; ++k) {
    const int x = u + range.offset + k;
    if (x >= costs.width) break;
    const int cost = costs.at(x, y, k);
    const int lowest = best < 0 ? 0x10000 : costs.at(u + range.offset + best, y, best);
    if (cost < lowest || (cost == lowest && config.right_winner == TieRule::kHighest)) best = k;
  }
  return best < 0 ? -1 : range.offset + best;
}

inline Grid<Disparity> naive_consistency(const ConsistencyConfig& config, DisparityRange range,
                                         const Grid<Cost>& costs, Grid<Disparity> map) {
  if (!config.enabled) return map;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      Disparity& d = map.at(x, y);
      if (!d.valid()) continue;
      const int left = naive_integer(d);
      bool keep = config.outside_match == OutsideMatch::kKeep;
      if (x - left >= 0) {
        const int right = naive_right_disparity(config, range, costs, x - left, y);
        keep = std::abs(left - right) <= config.threshold;
      }
      if (!keep) d = {kInvalidDisparity, Cause::kConsistency};
    }
  }
  return map;
}

}  // namespace parallax::test
