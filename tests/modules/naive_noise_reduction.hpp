// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "modules/noise_reduction.hpp"
#include "tests/modules/disparity_image.hpp"

namespace parallax::test {

inline DisparityImage naive_plain_median(int side, const DisparityImage& input) {
  DisparityImage output = input;
  const int h = side / 2;
  for (int y = h; y < input.height - h; ++y) {
    for (int x = h; x < input.width - h; ++x) {
      std::vector<int> all;
      for (int v = y - h; v <= y + h; ++v) {
        for (int u = x - h; u <= x + h; ++u)
          all.push_back(input.at(u, v).valid() ? input.at(u, v).value : 4095);
      }
      std::sort(all.begin(), all.end());
      const int median = all[all.size() / 2];
      Disparity& pixel = output.at(x, y);
      if (median == 4095 && pixel.valid()) pixel.cause = Cause::kNoise;
      if (median != 4095 && !pixel.valid()) pixel.cause = Cause::kMatched;
      pixel.value = static_cast<std::uint16_t>(median);
    }
  }
  return output;
}

inline DisparityImage naive_noise_reduction(const NoiseReductionConfig& config, const DisparityImage& input) {
  if (!config.enabled) return input;
  if (config.kind == NoiseReductionKind::kMedian3x3) return naive_plain_median(3, input);
  if (config.kind == NoiseReductionKind::kMedian5x5) return naive_plain_median(5, input);
  const int h = (config.window - 1) / 2;
  DisparityImage output = input;
  for (int y = 0; y < input.height; ++y) {
    for (int x = 0; x < input.width; ++x) {
      if (!input.at(x, y).valid()) continue;
      const int centre = input.at(x, y).value;
      std::vector<int> members;
      for (int v = y - h; v <= y + h; ++v) {
        for (int u = x - h; u <= x + h; ++u) {
          if (!input.inside(u, v) || !input.at(u, v).valid()) continue;
          if (std::abs(input.at(u, v).value - centre) <= config.max_difference)
            members.push_back(input.at(u, v).value);
        }
      }
      const int n = static_cast<int>(members.size());
      int value = 0;
      if (config.kind == NoiseReductionKind::kMean) {
        int sum = 0;
        for (const int member : members) sum += member;
        value = (2 * sum + n) / (2 * n);
      } else {
        std::sort(members.begin(), members.end());
        value = members[static_cast<std::size_t>((n - 1) / 2)];
      }
      output.at(x, y).value = static_cast<std::uint16_t>(value);
    }
  }
  return output;
}

}  // namespace parallax::test
