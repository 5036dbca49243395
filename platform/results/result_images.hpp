// SPDX-License-Identifier: Apache-2.0
// The results as pictures.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string_view>
#include <vector>

#include "modules/pixel.hpp"
#include "platform/results/color_scale.hpp"
#include "platform/results/disparity_view.hpp"
#include "platform/results/ground_truth.hpp"
#include "platform/results/legend.hpp"

namespace parallax {

/// disparity.png, CV_16UC1: value = disparity * 256, 0 = invalid (the KITTI convention). A valid disparity of
/// exactly 0 would read as invalid and is 1, that is 1/256 px.
cv::Mat disparity_values(const DisparityView& map);

/// The disparities in the colours of the scale, invalid ones black: CV_8UC3 (BGR) of the map's size.
cv::Mat disparity_colors(const DisparityView& map, const ColorScale& scale);
Legend disparity_legend(const ColorScale& scale);

/// What a cause looks like.
struct CauseStyle {
  Cause cause;
  std::string_view name;
  std::array<std::uint8_t, 3> rgb;
};
const std::array<CauseStyle, kCauses>& cause_styles();

/// The colour of each pixel's cause: CV_8UC3 (BGR) of the map's size.
cv::Mat cause_colors(const DisparityView& map);
Legend cause_legend();

/// cause_labels.png, for programs, CV_8UC1: value = number of the Cause.
cv::Mat cause_labels(const DisparityView& map);

/// How far each scored pixel is off, in the colours of error_scale(): CV_8UC3 (BGR) of the map's size.
/// Invalid pixels, and those that are not scored, have colours of their own, which the legend names. Throws
/// std::invalid_argument if the ground truth is of another size.
cv::Mat error_colors(const DisparityView& map, const GroundTruth& truth);
Legend error_legend();

}  // namespace parallax
