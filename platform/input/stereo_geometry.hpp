// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/matx.hpp>
#include <string>

namespace parallax {

/// What turns a disparity into a depth: a rectified pair, seen from its left camera.
struct StereoGeometry {
  double focal_x = 0;   ///< px, of both images
  double focal_y = 0;   ///< px, of both images
  double cx_left = 0;   ///< column of the principal point, px
  double cx_right = 0;  ///< px
  double cy = 0;        ///< its row in both images, px
  double baseline = 0;  ///< how far the right camera lies to the right, in the calibration's unit

  /// What is added to a disparity before depth = focal_x * baseline / (disparity + doffs), px. Where it is
  /// negative, disparities up to -doffs stand for no point before the cameras.
  double doffs() const { return cx_right - cx_left; }
};

/// (X, Y, Z, W) = Q (x, y, disparity, 1), as cv::stereoRectify defines it; with focal lengths that differ,
/// rows are scaled by focal_x / focal_y.
cv::Matx44d disparity_to_depth(const StereoGeometry& geometry);

/// Of the projections of a rectified pair, which have one frame of reference but need not lie in it: the
/// baseline is (P1(0,3) - P2(0,3)) / focal length. Unchecked.
StereoGeometry geometry_of(const cv::Matx34d& P1, const cv::Matx34d& P2);

/// Throws UserError, whose line begins with `where`, unless P1 and P2 are the projections of a rectified pair
/// whose right camera lies to the right of the left one: K [I | t] without skew, focal lengths of 1 to 1e7 px
/// that agree to 1e-4, principal points within 1e6 px whose rows agree to 0.1 px, and cameras that lie above
/// or before each other by no more than 2 % of the baseline, which is one row at a disparity of 50 px.
void check_projections(const cv::Matx34d& P1, const cv::Matx34d& P2, const std::string& where);

/// Of a matrix like that of disparity_to_depth(), up to a common factor. Throws UserError for any other one.
StereoGeometry geometry_of(const cv::Matx44d& Q, const std::string& where);

/// Throws UserError unless Q means what the projections do: focal lengths and baseline to 0.1 %, principal
/// points to 0.1 px.
void check_same(const StereoGeometry& of_projections, const StereoGeometry& of_q, const std::string& where);

}  // namespace parallax
