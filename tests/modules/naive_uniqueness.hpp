// SPDX-License-Identifier: Apache-2.0
// The uniqueness check as uniqueness.hpp defines it, on a whole volume.
#pragma once

#include <cmath>
#include <cstdlib>

#include "modules/uniqueness.hpp"
#include "tests/modules/images.hpp"

namespace parallax::test {

/// The nearest integer to value / 16, the lower one of two.
inline int naive_integer(Disparity d) { return static_cast<int>(std::ceil(d.value / 16.0 - 0.5)); }

inline Grid<Disparity> naive_uniqueness(const UniquenessConfig& config, DisparityRange range,
                                        const Grid<Cost>& costs, Grid<Disparity> map) {
  if (!config.enabled) return map;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      Disparity& d = map.at(x, y);
      if (!d.valid()) continue;
      const int k = naive_integer(d) - range.offset;
      bool keep = true;
      for (int j = 0; j < costs.depth; ++j) {
        const int distance = std::abs(j - k);
        if (distance == 0 || (distance == 1 && !config.neighbours_are_rivals)) continue;
        keep = keep && costs.at(x, y, k) * (config.factor / 256.0) < costs.at(x, y, j);
      }
      if (!keep) d = {kInvalidDisparity, Cause::kUniqueness};
    }
  }
  return map;
}

}  // namespace parallax::test
