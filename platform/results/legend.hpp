// SPDX-License-Identifier: Apache-2.0
// What a picture says about itself, in white on black.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "platform/results/color_scale.hpp"

namespace parallax {

/// A bar of colours with numbers below.
struct LegendScale {
  std::string title;  ///< what is shown and in which unit: "disparity, px"
  ColorScale colors;
  bool open = false;  ///< values beyond the last number occur, and have its colour: "5+"
};

/// A colour with its name.
struct LegendEntry {
  std::string name;
  cv::Vec3b color;  ///< BGR
};

struct Legend {
  std::optional<LegendScale> scale;
  std::vector<LegendEntry> entries;
};

/// The numbers at the ticks of a scale, ascending: its ends and, in between, multiples of 1, 2 or 5 times a
/// power of ten, `most` in all and at least the ends.
std::vector<int> scale_ticks(int lowest, int highest, int most);

/// Where a scale lies in the legend of a picture `width` px wide, px: its lowest value in column `first`, its
/// highest in column `last`; the bar in rows `top` to `bottom`, ticks in the rows below.
struct ScalePlace {
  int first;
  int last;
  int top;
  int bottom;

  int column(const LegendScale& scale, int value) const;
};
ScalePlace scale_place(const LegendScale& scale, int width);

/// The legend, CV_8UC3 (BGR), `width` px wide and as high as it needs. A picture of 96 px has room for it,
/// and text grows with pictures above 512 px. No rows at all below 96 px.
cv::Mat draw_legend(const Legend& legend, int width);

/// The picture, CV_8UC3, with its legend below.
cv::Mat with_legend(const cv::Mat& picture, const Legend& legend);

/// Two pictures of one size, CV_8UC3, next to each other, their captions above (unless they are
/// narrower than 96 px) and the legend below. The left one begins in column 0, the right one ends in the last
/// column.
cv::Mat side_by_side(const cv::Mat& left, const std::string& left_caption, const cv::Mat& right,
                     const std::string& right_caption, const Legend& legend);

}  // namespace parallax
