// SPDX-License-Identifier: Apache-2.0
#include "platform/results/color_scale.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

namespace parallax {
namespace {

constexpr int kScaleColors = 256;
constexpr int kHighestError = 5;  // px: beyond the limits of bad-1 to bad-3

/// The colours of a map of OpenCV's from its entry `first` on.
std::vector<cv::Vec3b> map_colors(int map, int first) {
  cv::Mat ramp(1, kScaleColors, CV_8UC1);
  for (int i = 0; i < kScaleColors; ++i) {
    ramp.at<std::uint8_t>(0, i) =
        static_cast<std::uint8_t>(first + i * (kScaleColors - 1 - first) / (kScaleColors - 1));
  }
  cv::Mat colors;
  cv::applyColorMap(ramp, colors, map);
  return {colors.begin<cv::Vec3b>(), colors.end<cv::Vec3b>()};
}

}  // namespace

ColorScale::ColorScale(int lowest, int highest, std::vector<cv::Vec3b> colors)
    : lowest_(lowest), highest_(highest), colors_(std::move(colors)) {
  if (highest < lowest || colors_.empty()) throw std::invalid_argument("a colour scale is empty");
}

std::size_t ColorScale::index(double value) const {
  const double share = (value - lowest_) / std::max(1, highest_ - lowest_);
  return static_cast<std::size_t>(
      std::lround(std::clamp(share, 0.0, 1.0) * static_cast<double>(colors_.size() - 1)));
}

ColorScale disparity_scale(int lowest, int highest) {
  constexpr int kFirstBright = 24;  // those before look black
  return {lowest, highest, map_colors(cv::COLORMAP_TURBO, kFirstBright)};
}

ColorScale error_scale() { return {0, kHighestError, map_colors(cv::COLORMAP_INFERNO, 0)}; }

}  // namespace parallax
