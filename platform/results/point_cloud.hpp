// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/matx.hpp>
#include <vector>

#include "platform/results/disparity_view.hpp"

namespace parallax {

/// points.ply: a binary little-endian PLY file with one vertex (float x y z, uchar red green blue) for each
/// valid disparity, row by row. (X, Y, Z, W) = Q (x, y, d, 1), the point is (X, Y, Z) / W in the unit of the
/// calibration's baseline, its grey that of the rectified left image (CV_8UC1, of the map's size). Points at
/// infinity, or beyond the largest float, are left out, and so are those behind the camera, Z <= 0: a comment
/// of the file says how many. Throws std::invalid_argument if the image is of another format or size.
std::vector<unsigned char> encode_point_cloud_ply(const DisparityView& map, const cv::Mat& left,
                                                  const cv::Matx44d& q);

}  // namespace parallax
