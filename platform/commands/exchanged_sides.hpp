// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

namespace parallax {

/// Whether the pair would plainly match better the other way round: of textured patches of the left image, at
/// a reduced size, those that resemble the right image much more to their right (disparities below 0) are at
/// least 16 and outnumber those that resemble it more to their left by four to one. 8-bit images of one size;
/// `largest`: disparity looked for, px; `rows`: how far the rows of the two may lie apart, px.
bool sides_look_exchanged(const cv::Mat& left, const cv::Mat& right, int largest, int rows);

}  // namespace parallax
