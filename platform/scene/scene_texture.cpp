// SPDX-License-Identifier: Apache-2.0
#include "platform/scene/scene_texture.hpp"

#include <algorithm>

#include "platform/scene/scene_hash.hpp"

namespace parallax {
namespace {

/// Adds value noise of one lattice to `sum`: random values at every 2^lattice_log2 texels, smoothstep between
/// them.
void add_octave(std::vector<int>& sum, int period_log2, int lattice_log2, int weight, std::uint64_t seed) {
  const int period = 1 << period_log2;
  const int lattice = 1 << lattice_log2;
  const int nodes = period / lattice;
  std::vector<int> smooth(lattice);  // 0..4096: 3 t^2 - 2 t^3
  for (int i = 0; i < lattice; ++i) {
    const std::int64_t t = (std::int64_t{i} << 12) / lattice;
    smooth[i] = static_cast<int>((t * t * (3 * 4096 - 2 * t)) >> 24);
  }
  const auto node = [&](int x, int y) {
    const std::uint64_t index = (y & (nodes - 1)) * nodes + (x & (nodes - 1));
    return static_cast<int>(scene_hash(seed, index) >> 48) - 32768;
  };
  for (int ny = 0; ny < nodes; ++ny) {
    for (int nx = 0; nx < nodes; ++nx) {
      const int v00 = node(nx, ny), v10 = node(nx + 1, ny), v01 = node(nx, ny + 1),
                v11 = node(nx + 1, ny + 1);
      for (int y = 0; y < lattice; ++y) {
        const int sy = smooth[y];
        const int left = v00 + (((v01 - v00) * sy) >> 12);
        const int right = v10 + (((v11 - v10) * sy) >> 12);
        int* row = &sum[((ny << lattice_log2) + y) * period + (nx << lattice_log2)];
        for (int x = 0; x < lattice; ++x) {
          row[x] += ((left + (((right - left) * smooth[x]) >> 12)) * weight) >> 6;
        }
      }
    }
  }
}

std::vector<int> fractal(int period_log2, int first_lattice_log2, int last_lattice_log2, std::uint64_t seed) {
  std::vector<int> sum(std::size_t{1} << (2 * period_log2), 0);
  for (int lattice = first_lattice_log2; lattice <= std::min(last_lattice_log2, period_log2 - 1); ++lattice) {
    // Weights grow with the wavelength, as natural images' spectra do; 64 is a gain of one. The sum of all
    // has a standard deviation of a fifth of the full range, so that hardly anything is clipped to a flat
    // area.
    add_octave(sum, period_log2, lattice, 14 + 3 * lattice, scene_hash(seed, lattice));
  }
  return sum;
}

}  // namespace

SceneTexture::SceneTexture(Kind kind, std::uint64_t seed, int period_log2)
    : shift_(period_log2), mask_((std::uint64_t{1} << period_log2) - 1) {
  std::vector<int> sum = fractal(period_log2, 1, 7, seed);
  if (kind != Kind::kFractal) {
    const std::vector<int> shape = fractal(period_log2, 4, 6, scene_hash(seed, 99));
    const int period = 1 << period_log2;
    for (std::size_t i = 0; i < sum.size(); ++i) {
      const int x = static_cast<int>(i) & (period - 1);
      const int y = static_cast<int>(i) >> period_log2;
      int level = 0;
      if (kind == Kind::kPatches) {
        // Posterised: four levels, their borders are the edges.
        level = (std::clamp(shape[i], -16000, 15999) + 16000) / 8000 * 12000 - 18000;
      } else {
        // Stripes of 16 texels, bent and widened by the noise; 16 divides every period.
        level = ((2 * x + y + (shape[i] >> 11)) & 31) < 16 ? -13000 : 13000;
      }
      sum[i] = sum[i] * 3 / 4 + level;
    }
  }
  texels_.resize(sum.size());
  std::transform(sum.begin(), sum.end(), texels_.begin(),
                 [](int value) { return static_cast<std::uint16_t>(std::clamp(value + 32768, 0, 65535)); });
}

}  // namespace parallax
