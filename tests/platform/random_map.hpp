// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "modules/pixel.hpp"
#include "platform/scene/scene_hash.hpp"

namespace parallax::test {

/// Disparities and causes of all kinds.
inline std::vector<Disparity> random_map(int width, int height, std::uint64_t seed) {
  std::vector<Disparity> map(static_cast<std::size_t>(width * height));
  for (std::size_t i = 0; i < map.size(); ++i) {
    const std::uint64_t random = scene_hash(seed, i);
    map[i].cause = static_cast<Cause>(random & 7);
    map[i].value = map[i].cause <= Cause::kInterpolated ? static_cast<std::uint16_t>((random >> 8) % 0xFFF)
                                                        : kInvalidDisparity;
  }
  return map;
}

}  // namespace parallax::test
