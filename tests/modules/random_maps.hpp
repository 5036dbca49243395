// SPDX-License-Identifier: Apache-2.0
// Maps for the tests: smooth as a lens makes them, and extreme.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "modules/rectification_map.hpp"

namespace parallax::test {

/// Every offset drawn from the whole range: nothing to predict.
inline RectificationMap noise_map(int width, int height, const OffsetRange& range, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> offset(-range.limit(), range.limit());
  const auto draw = [&] { return static_cast<std::int16_t>(offset(random)); };
  RectificationMap map = identity_map(width, height, range);
  for (OffsetPair& pair : map.offsets) {
    pair = {{draw(), draw()}, {draw(), draw()}};
  }
  return map;
}

/// Jumps between the ends of the range, in the pattern that a plane predictor likes least.
inline RectificationMap chessboard_map(int width, int height, const OffsetRange& range) {
  RectificationMap map = identity_map(width, height, range);
  const auto limit = static_cast<std::int16_t>(range.limit());
  for (std::size_t i = 0; i < map.offsets.size(); ++i) {
    const bool odd = (i % static_cast<std::size_t>(width) + i / static_cast<std::size_t>(width)) % 2 != 0;
    const auto value = static_cast<std::int16_t>(odd ? limit : -limit);
    const auto opposite = static_cast<std::int16_t>(-value);
    map.offsets[i] = {{value, opposite}, {opposite, value}};
  }
  return map;
}

/// A radial lens that uses the whole window: offset = limit * (r / r_max)^2 toward the centre, the right one
/// outward.
inline RectificationMap lens_map(int width, int height, const OffsetRange& range) {
  RectificationMap map = identity_map(width, height, range);
  const double cx = (width - 1) / 2.0;
  const double cy = (height - 1) / 2.0;
  const double corner = std::max(1.0, cx * cx + cy * cy);
  const double limit = range.limit();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double strength =
          limit * ((x - cx) * (x - cx) + (y - cy) * (y - cy)) / corner / std::sqrt(corner);
      const auto dx = static_cast<std::int16_t>(std::lrint(-strength * (x - cx)));
      const auto dy = static_cast<std::int16_t>(std::lrint(-strength * (y - cy)));
      map.offsets[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)] = {
          {dx, dy}, {static_cast<std::int16_t>(-dx), static_cast<std::int16_t>(-dy)}};
    }
  }
  return map;
}

}  // namespace parallax::test
