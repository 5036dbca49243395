// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>

#include "modules/speckle.hpp"
#include "tests/modules/disparity_image.hpp"

namespace parallax::test {

inline DisparityImage naive_speckle(const SpeckleConfig& config, const DisparityImage& input) {
  const int h = (config.window - 1) / 2;
  DisparityImage output = input;
  for (int pass = 0; pass < config.iterations; ++pass) {
    const DisparityImage before = output;
    for (int y = 0; y < input.height; ++y) {
      for (int x = 0; x < input.width; ++x) {
        const Disparity centre = before.at(x, y);
        if (!centre.valid()) continue;
        int n = 0;
        for (int v = y - h; v <= y + h; ++v) {
          for (int u = x - h; u <= x + h; ++u) {
            if (!before.inside(u, v) || !before.at(u, v).valid()) continue;
            if (std::abs(before.at(u, v).value - centre.value) <= config.max_difference) ++n;
          }
        }
        if (100 * n < config.min_similar_percent * config.window * config.window) {
          output.at(x, y) = {kInvalidDisparity, Cause::kSpeckle};
        }
      }
    }
  }
  return output;
}

}  // namespace parallax::test
