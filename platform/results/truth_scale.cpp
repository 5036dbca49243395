// SPDX-License-Identifier: Apache-2.0
#include "platform/results/truth_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "platform/results/disparity_view.hpp"
#include "tlm/units.hpp"

namespace parallax {
namespace {

struct Both {
  double found = 0;  // px
  double truth = 0;  // px, by the scale of the truth
};

// Pixels that agree when the truth is multiplied by this.
double agreeing(const std::vector<Both>& pixels, double factor) {
  constexpr double kNear = 1, kNearShare = 0.05;
  const auto near = std::count_if(pixels.begin(), pixels.end(), [&](const Both& pixel) {
    return std::abs(pixel.truth * factor - pixel.found) <= std::max(kNear, kNearShare * pixel.found);
  });
  return quotient(near, static_cast<std::int64_t>(pixels.size()));
}

double common_scale(double scale) {
  constexpr double kClose = 0.06;
  for (const double common :
       {1., 2., 3., 4., 5., 8., 10., 16., 32., 64., 100., 128., 256., 512., 1000., 1024.}) {
    if (std::abs(scale / common - 1) <= kClose) return common;
  }
  return scale;
}

}  // namespace

std::optional<double> better_truth_scale(const std::vector<Disparity>& found, const GroundTruth& truth) {
  constexpr std::size_t kFewest = 100;
  constexpr double kHardly = 0.25, kMost = 0.5;
  std::vector<Both> pixels;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (truth.scored(i) && found[i].valid() && in_pixels(found[i]) > 0)
      pixels.push_back({in_pixels(found[i]), truth.disparity[i]});
  }
  if (pixels.size() < kFewest || agreeing(pixels, 1) >= kHardly) return std::nullopt;
  const auto middle = pixels.begin() + static_cast<std::ptrdiff_t>(pixels.size() / 2);
  std::nth_element(pixels.begin(), middle, pixels.end(),
                   [](const Both& a, const Both& b) { return a.truth * b.found < b.truth * a.found; });
  const double scale = common_scale(truth.scale * middle->truth / middle->found);
  if (agreeing(pixels, truth.scale / scale) < kMost) return std::nullopt;
  return scale;
}

std::string truth_scale_notice(const std::vector<Disparity>& found, const GroundTruth& truth) {
  const auto scale = better_truth_scale(found, truth);
  if (!scale) return {};
  return fmt::format(
      "the ground truth looks like one of another scale: nearly all of it is off by one factor, and "
      "--ground-truth-scale {:.4g} instead of {:g} would fit",
      *scale, truth.scale);
}

}  // namespace parallax
