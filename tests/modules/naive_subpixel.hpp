// SPDX-License-Identifier: Apache-2.0
// Winner and subpixel refinement as subpixel.hpp defines them, on a whole volume.
#pragma once

#include <algorithm>

#include "modules/subpixel.hpp"
#include "tests/modules/images.hpp"

namespace parallax::test {

inline int naive_winner(const Grid<Cost>& costs, int x, int y, TieRule rule) {
  int best = 0;
  for (int k = 1; k < costs.depth; ++k) {
    const int a = costs.at(x, y, k);
    const int b = costs.at(x, y, best);
    if (a < b || (a == b && rule == TieRule::kHighest)) best = k;
  }
  return best;
}

/// f of the definition, found by trying: the allowed f closest to n / m.
inline int naive_fraction(const SubpixelConfig& config, int a, int c, int b) {
  const int n = 8 * (a - b);
  int m = 0;
  if (config.curve == SubpixelCurve::kParabola) m = a - 2 * c + b;
  if (config.curve == SubpixelCurve::kEquiangular) m = std::max(a, b) - c;
  if (m == 0) return 0;
  if (config.rounding == SubpixelRounding::kTruncate) {
    int f = 0;
    while (n >= 0 && (f + 1) * m <= n) ++f;
    while (n < 0 && (f - 1) * m >= n) --f;
    return f;
  }
  int f = 0;
  while (n >= 0 && 2 * n >= (2 * f + 1) * m) ++f;
  while (n < 0 && 2 * n <= (2 * f - 1) * m) --f;
  if (f == 8 && n < 8 * m) f = 7;
  if (f == -8 && n > -8 * m) f = -7;
  return f;
}

inline Grid<Disparity> naive_subpixel(const SubpixelConfig& config, DisparityRange range,
                                      const Grid<Cost>& costs) {
  Grid<Disparity> out(costs.width, costs.height);
  for (int y = 0; y < costs.height; ++y) {
    for (int x = 0; x < costs.width; ++x) {
      if (config.mask_border &&
          (x < config.border_width || y < config.border_height || x >= costs.width - config.border_width ||
           y >= costs.height - config.border_height)) {
        out.at(x, y) = {kInvalidDisparity, Cause::kBorder};
        continue;
      }
      const int k = naive_winner(costs, x, y, config.winner);
      int value = 16 * (range.offset + k);
      if (k > 0 && k < costs.depth - 1 && config.curve != SubpixelCurve::kNone) {
        value += naive_fraction(config, costs.at(x, y, k - 1), costs.at(x, y, k), costs.at(x, y, k + 1));
      }
      out.at(x, y) = {static_cast<std::uint16_t>(value), Cause::kMatched};
    }
  }
  return out;
}

}  // namespace parallax::test
