// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "modules/matching.hpp"

namespace parallax {

/// Where the pixel before lies along a path of semi-global matching, in an image that is scanned so that it
/// has come by then (path_order()).
struct PathStep {
  int dx = 0;       ///< columns further in the scan, -1 to 1
  int rows_up = 0;  ///< 0 or 1
  PathStart start = PathStart::kCost;

  /// Position in the scan, row by row, of the predecessor of the pixel in column x of row y; negative: none.
  int predecessor(int x, int y, int width) const {
    const int from_x = x + dx;
    const int here = y * width + x;
    const int there = here - rows_up * width + dx;
    if (x == 0 && start == PathStart::kFirstColumn) return -1;
    if (from_x >= 0 && from_x < width) return there;
    const bool horizontal = rows_up == 0;
    switch (start) {
      case PathStart::kCost:
        return -1;
      case PathStart::kClamp:
        return horizontal ? -1 : here - width;
      case PathStart::kCarry:
        return horizontal ? there : -1;
      case PathStart::kDelayLine:
      case PathStart::kFirstColumn:
        return there < here ? there : -1;
    }
    return -1;
  }
};

/// Of one of the paths that are configured.
PathStep path_step(const MatchingConfig& config, PathBit path);

}  // namespace parallax
