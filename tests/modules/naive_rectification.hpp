// SPDX-License-Identifier: Apache-2.0
// Naive reference: the definition in modules/rectification.hpp, image by image.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "modules/pixel.hpp"

namespace parallax::test {

inline std::vector<Gray> naive_rectify(const std::vector<Gray>& image, int width, int height,
                                       const std::vector<Offset>& offsets, int fraction_bits, bool nearest) {
  const int scale = 1 << fraction_bits;
  const auto at = [&](int i, int j) {
    const int x = std::clamp(i, 0, width - 1);
    const int y = std::clamp(j, 0, height - 1);
    return static_cast<int>(image[static_cast<std::size_t>(y * width + x)]);
  };
  const auto floor_divide = [](int a, int b) { return a >= 0 ? a / b : -((-a + b - 1) / b); };
  std::vector<Gray> out(image.size());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Offset offset = offsets[static_cast<std::size_t>(y * width + x)];
      const int ix = x + floor_divide(offset.dx, scale);
      const int iy = y + floor_divide(offset.dy, scale);
      const int fx = offset.dx - (ix - x) * scale;
      const int fy = offset.dy - (iy - y) * scale;
      const int sum = (scale - fy) * ((scale - fx) * at(ix, iy) + fx * at(ix + 1, iy)) +
                      fy * ((scale - fx) * at(ix, iy + 1) + fx * at(ix + 1, iy + 1));
      const int half = nearest ? scale * scale / 2 : 0;
      out[static_cast<std::size_t>(y * width + x)] = static_cast<Gray>((sum + half) / (scale * scale));
    }
  }
  return out;
}

}  // namespace parallax::test
