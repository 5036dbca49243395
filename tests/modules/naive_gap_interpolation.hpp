// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdlib>

#include "modules/gap_interpolation.hpp"
#include "tests/modules/disparity_image.hpp"

namespace parallax::test {

inline DisparityImage naive_gap_interpolation(const GapInterpolationConfig& config,
                                              const DisparityImage& input) {
  if (!config.enabled) return input;
  const auto gap = [&](int x, int y) {
    return input.inside(x, y) && !input.at(x, y).valid() && input.at(x, y).cause != Cause::kBorder;
  };
  struct Candidate {
    int length = 0;  // 0: cannot be bridged
    int value = 0;
  };
  // Along (dx, dy): walk from the pixel to both edges of its run.
  const auto candidate = [&](int x, int y, int dx, int dy) -> Candidate {
    int back = 0;
    while (gap(x - (back + 1) * dx, y - (back + 1) * dy)) ++back;
    int on = 0;
    while (gap(x + (on + 1) * dx, y + (on + 1) * dy)) ++on;
    const int length = back + 1 + on;
    const int ax = x - (back + 1) * dx, ay = y - (back + 1) * dy;
    const int bx = x + (on + 1) * dx, by = y + (on + 1) * dy;
    if (!input.inside(ax, ay) || !input.at(ax, ay).valid()) return {};
    if (!input.inside(bx, by) || !input.at(bx, by).valid()) return {};
    const int a = input.at(ax, ay).value, b = input.at(bx, by).value;
    if (length > config.l_max || std::abs(a - b) > config.max_difference) return {};
    const int i = back + 1;
    // At most 65 parts of at most 12 bits: a double holds the quotient well enough to find its floor, because
    // it is at least 1/130 away from the next integer unless it is one.
    const double exact =
        (static_cast<double>(a) * (length + 1 - i) + static_cast<double>(b) * i) / (length + 1);
    const double half = config.rounding == InterpolationRounding::kNearest ? 0.5 : 0.0;
    return {length, static_cast<int>(std::floor(exact + half + 1e-6))};
  };
  DisparityImage output = input;
  for (int y = 0; y < input.height; ++y) {
    for (int x = 0; x < input.width; ++x) {
      if (!gap(x, y)) continue;
      const Candidate horizontal = candidate(x, y, 1, 0);
      const Candidate vertical = candidate(x, y, 0, 1);
      Candidate chosen = horizontal;
      if (horizontal.length == 0 || (vertical.length > 0 && vertical.length < horizontal.length))
        chosen = vertical;
      if (chosen.length > 0)
        output.at(x, y) = {static_cast<std::uint16_t>(chosen.value), Cause::kInterpolated};
    }
  }
  return output;
}

}  // namespace parallax::test
