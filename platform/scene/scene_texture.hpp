// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace parallax {

/// A tile of texture that repeats without a seam: multi-octave value noise, alone or with edges. All integer
/// arithmetic, so that a seed gives the same texture on every machine.
class SceneTexture {
 public:
  enum class Kind {
    kFractal,  ///< seven octaves of value noise, lattices of 2 to 128 texels
    kPatches,  ///< fractal on areas of different brightness with sharp, irregular edges
    kStripes,  ///< fractal on slanting stripes of irregular width
  };

  /// `period_log2`: the tile's side is 2^period_log2 texels, 64 to 2048.
  SceneTexture(Kind kind, std::uint64_t seed, int period_log2);

  /// Bilinear value at (u, v), both in 1/256 texel and of any sign: 0..65535, the mean is near 32768.
  int sample(std::int64_t u, std::int64_t v) const {
    const std::uint64_t x = (u >> 8) & mask_;
    const std::uint64_t y = (v >> 8) & mask_;
    const std::uint16_t* row0 = &texels_[y << shift_];
    const std::uint16_t* row1 = &texels_[((y + 1) & mask_) << shift_];
    const std::uint64_t x1 = (x + 1) & mask_;
    const int fu = u & 255;
    const int fv = v & 255;
    const int top = row0[x] * (256 - fu) + row0[x1] * fu;
    const int bottom = row1[x] * (256 - fu) + row1[x1] * fu;
    // 16 + 8 bits so far: drop 4 before the second weight, so that the sum stays within 31 bits.
    return ((top >> 4) * (256 - fv) + (bottom >> 4) * fv) >> 12;
  }

 private:
  int shift_;
  std::uint64_t mask_;
  std::vector<std::uint16_t> texels_;
};

}  // namespace parallax
