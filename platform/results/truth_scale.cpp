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

// Those that are scored and have a disparity, when hardly any agrees with the truth and there are enough.
std::vector<Both> disagreeing(const std::vector<Disparity>& found, const GroundTruth& truth) {
  constexpr std::size_t kFewest = 100;
  constexpr double kHardly = 0.25;
  std::vector<Both> pixels;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (truth.scored(i) && found[i].valid() && in_pixels(found[i]) > 0)
      pixels.push_back({in_pixels(found[i]), truth.disparity[i]});
  }
  if (pixels.size() < kFewest || agreeing(pixels, 1) >= kHardly) pixels.clear();
  return pixels;
}

constexpr double kMost = 0.5;

// The middle pixel in the order of a number that each has.
template <class Number>
Both middle_by(std::vector<Both> pixels, const Number& number) {
  const auto middle = pixels.begin() + static_cast<std::ptrdiff_t>(pixels.size() / 2);
  std::nth_element(pixels.begin(), middle, pixels.end(),
                   [&](const Both& a, const Both& b) { return number(a) < number(b); });
  return *middle;
}

// What disparity and depth multiplied are, if the truth is depth.
std::optional<double> focal_times_baseline(const std::vector<Disparity>& found, const GroundTruth& truth) {
  std::vector<Both> pixels = disagreeing(found, truth);
  if (pixels.empty()) return std::nullopt;
  const auto product = [](const Both& pixel) { return pixel.found * pixel.truth; };
  const double middle = product(middle_by(pixels, product));
  for (Both& pixel : pixels) pixel.truth = middle / pixel.truth;
  if (agreeing(pixels, 1) < kMost) return std::nullopt;
  return middle;
}

}  // namespace

std::optional<double> better_truth_scale(const std::vector<Disparity>& found, const GroundTruth& truth) {
  const std::vector<Both> pixels = disagreeing(found, truth);
  if (pixels.empty()) return std::nullopt;
  const Both middle = middle_by(pixels, [](const Both& pixel) { return pixel.truth / pixel.found; });
  const double scale = common_scale(truth.scale * middle.truth / middle.found);
  if (agreeing(pixels, truth.scale / scale) < kMost) return std::nullopt;
  return scale;
}

std::string truth_scale_notice(const std::vector<Disparity>& found, const GroundTruth& truth) {
  if (const auto scale = better_truth_scale(found, truth)) {
    return fmt::format(
        "the ground truth looks like one of another scale: nearly all of it is off by one factor, and "
        "--ground-truth-scale {:.4g} instead of {:g} would fit",
        *scale, truth.scale);
  }
  if (const auto product = focal_times_baseline(found, truth)) {
    return fmt::format(
        "the ground truth looks like depth, not like disparities: both multiplied are {0:.4g} nearly "
        "everywhere, and disparity = {0:.4g} / depth",
        *product);
  }
  return {};
}

}  // namespace parallax
