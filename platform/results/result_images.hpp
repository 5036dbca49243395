// SPDX-License-Identifier: Apache-2.0
// The results as pictures: each function returns the bytes of a PNG file.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string_view>
#include <vector>

#include "modules/pixel.hpp"
#include "platform/results/disparity_view.hpp"

namespace parallax {

/// A CV_8UC1, CV_16UC1 or CV_8UC3 (BGR) image.
std::vector<unsigned char> encode_png(const cv::Mat& image);

/// disparity.png: 16 bit, value = disparity * 256, 0 = invalid (the KITTI convention). A valid disparity of
/// exactly 0 would read as invalid and is written as 1, that is 1/256 px.
std::vector<unsigned char> encode_disparity_png(const DisparityView& map);

/// The disparities at the ends of the colour scale, px.
struct ColorRange {
  int lowest = 0;     ///< blue: disparity offset
  int highest = 255;  ///< red: disparity offset + range - 1
};

/// disparity_color.png: far is blue, near is red, invalid is black. Below the map, where it is wide enough
/// for text, a strip of 24 rows shows the scale.
std::vector<unsigned char> encode_disparity_color_png(const DisparityView& map, const ColorRange& range);

/// What a cause looks like in causes.png.
struct CauseStyle {
  Cause cause;
  std::string_view name;
  std::array<std::uint8_t, 3> rgb;
};
const std::array<CauseStyle, 8>& cause_styles();

/// causes.png: the colour of each pixel's cause; below the map, where it is wide enough for text, their
/// names.
std::vector<unsigned char> encode_causes_png(const DisparityView& map);

/// cause_labels.png, for programs: 8 bit, value = number of the Cause.
std::vector<unsigned char> encode_cause_labels_png(const DisparityView& map);

}  // namespace parallax
