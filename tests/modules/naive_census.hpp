// SPDX-License-Identifier: Apache-2.0
// The census transform as census.hpp defines it, on a whole image.
#pragma once

#include <algorithm>

#include "modules/census.hpp"
#include "tests/modules/images.hpp"

namespace parallax::test {

inline Grid<CensusCode> naive_census(const CensusConfig& config, const Grid<Gray>& image) {
  const int w = image.width;
  const int h = image.height;
  Grid<CensusCode> codes(w, h);
  if (!config.enabled) {
    for (int i = 0; i < w * h; ++i) codes.data[i] = image.data[i];
    return codes;
  }
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      CensusCode code = 0;
      int i = 0;
      bool leaves = false;
      for (int v = y - config.window_height / 2; v <= y + config.window_height / 2; ++v) {
        for (int u = x - config.window_width / 2; u <= x + config.window_width / 2; ++u) {
          if (u == x && v == y) continue;
          const bool outside = u < 0 || v < 0 || u >= w || v >= h;
          leaves = leaves || outside;
          int neighbour = image.at(std::clamp(u, 0, w - 1), std::clamp(v, 0, h - 1));
          if (outside && config.border == CensusBorder::kZero) neighbour = 0;
          if (config.border == CensusBorder::kDelayLine) {
            const int position = v * w + u;  // in raster order, wherever that lies
            neighbour = position < 0 || position >= w * h ? 0 : image.at(position % w, position / w);
          }
          const int centre = image.at(x, y);
          bool bit = false;
          if (config.comparison == CensusComparison::kLess) bit = neighbour < centre;
          if (config.comparison == CensusComparison::kLessEqual) bit = neighbour <= centre;
          if (config.comparison == CensusComparison::kGreater) bit = neighbour > centre;
          if (config.comparison == CensusComparison::kGreaterEqual) bit = neighbour >= centre;
          const int position = config.bit_order == CensusBitOrder::kLsbFirst ? i : config.code_bits() - 1 - i;
          if (bit) code |= CensusCode{1} << position;
          ++i;
        }
      }
      codes.at(x, y) = leaves && config.border == CensusBorder::kMask ? 0 : code;
    }
  }
  return codes;
}

}  // namespace parallax::test
