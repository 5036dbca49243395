// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <functional>

#include "modules/pixel.hpp"
#include "modules/scan_order.hpp"

namespace parallax {

/// Paths that semi-global matching can have (PathBit).
inline constexpr int kMostPaths = 8;

/// Names of the paths, in the order of their bits (PathBit): where the predecessor lies.
inline constexpr std::array<const char*, kMostPaths> kPathNames{"w", "nw", "n", "ne", "e", "sw", "s", "se"};

/// Takes what semi-global matching works out on the way to its sums (matching.hpp), as its kernel has it: a
/// row at a time of width * range().count values, a pixel's disparities rising. What has no taker costs
/// nothing.
struct MatchingTaps {
  using Take = std::function<void(const Cost* row)>;

  Take pixel_costs;  ///< C; in raster order. A second pass works them out again, and they are not taken again
  /// L_r of the paths that are configured, in the order of their bits, as it goes into the sum; rows and
  /// pixels as path_order() says.
  std::array<Take, kMostPaths> paths;

  bool any() const {
    return pixel_costs || std::any_of(paths.begin(), paths.end(), [](const Take& take) { return !!take; });
  }
};

}  // namespace parallax
