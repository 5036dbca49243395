// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <opencv2/core/matx.hpp>
#include <vector>

namespace parallax {

/// Colours (BGR) for the values from `lowest` to `highest`, px; what lies beyond has the colour of the nearer
/// end.
class ColorScale {
 public:
  /// `colors`: at least one, from that of `lowest` to that of `highest`, equally far apart.
  ColorScale(int lowest, int highest, std::vector<cv::Vec3b> colors);

  int lowest() const { return lowest_; }
  int highest() const { return highest_; }
  const std::vector<cv::Vec3b>& colors() const { return colors_; }

  /// Of the nearest colour, 0..colors().size() - 1.
  std::size_t index(double value) const;
  const cv::Vec3b& color(double value) const { return colors_[index(value)]; }

 private:
  int lowest_;
  int highest_;
  std::vector<cv::Vec3b> colors_;
};

/// Disparities: far is blue, near is red. 256 colours, none of them dark: black means invalid.
ColorScale disparity_scale(int lowest, int highest);

/// Absolute errors from 0 to 5 px: none is black, many are yellow. 256 colours.
ColorScale error_scale();

}  // namespace parallax
