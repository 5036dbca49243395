// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdlib>

#include "modules/texture.hpp"
#include "tests/modules/disparity_image.hpp"

namespace parallax::test {

inline DisparityImage naive_texture(const TextureConfig& config, const Image<Gray>& image,
                                    const DisparityImage& input) {
  if (!config.enabled) return input;
  DisparityImage output = input;
  const int h = (config.window - 1) / 2;
  const auto replicated = [&](int u, int v) -> int {
    return image.at(std::clamp(u, 0, image.width - 1), std::clamp(v, 0, image.height - 1));
  };
  for (int y = 0; y < input.height; ++y) {
    for (int x = 0; x < input.width; ++x) {
      int sum = 0;
      for (int v = y - h; v <= y + h; ++v) {
        for (int u = x - h + 1; u <= x + h; ++u) sum += std::abs(replicated(u, v) - replicated(u - 1, v));
      }
      const bool plain = 32 * sum < config.threshold * config.window * (config.window - 1);
      if (plain && input.at(x, y).valid()) output.at(x, y) = {kInvalidDisparity, Cause::kTexture};
    }
  }
  return output;
}

}  // namespace parallax::test
