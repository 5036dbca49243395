// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <stdexcept>
#include <vector>

#include "modules/area.hpp"
#include "modules/pixel.hpp"

namespace parallax {

/// A valid disparity, px.
inline double in_pixels(const Disparity& disparity) {
  return disparity.value / double{1 << kDisparityFractionBits};
}

/// A disparity map that belongs to somebody else: rows from top to bottom without gaps.
struct DisparityView {
  DisparityView(const std::vector<Disparity>& map, int map_width, int map_height)
      : pixels(map.data()), width(map_width), height(map_height) {
    if (width < 1 || height < 1 || map.size() != area(width, height)) {
      throw std::invalid_argument("a disparity map's size is not that of its pixels");
    }
  }

  const Disparity* row(int y) const { return pixels + std::ptrdiff_t{y} * width; }

  const Disparity* pixels;
  int width;
  int height;
};

}  // namespace parallax
