// SPDX-License-Identifier: Apache-2.0
#include "platform/input/rectify_pair.hpp"

#include <fmt/format.h>

#include <cmath>
#include <opencv2/calib3d.hpp>

#include "tlm/error.hpp"

namespace parallax {
namespace {

// For lenses of about 150 degrees and more, cv::fisheye::stereoRectify derives focal length and principal
// point from rays near or behind the image plane, and the rectified image shows nothing of the scene. The
// lenses' own mean focal length and the image's centre then stand in.
void repair_wide_fisheye(RectifiedPair& found, const StatedCalibration& stated) {
  const ImageSize& size = stated.size;
  const auto plausible = [&size](const cv::Matx34d& p) {
    return p(0, 0) > 0 && p(0, 2) >= 0 && p(0, 2) <= size.width && p(1, 2) >= 0 && p(1, 2) <= size.height;
  };
  if (plausible(found.P1) && plausible(found.P2)) return;
  const cv::Matx33d& left = stated.left->lens.camera;
  const cv::Matx33d& right = stated.right->lens.camera;
  const double focal = (left(0, 0) + left(1, 1) + right(0, 0) + right(1, 1)) / 4;
  const cv::Vec3d baseline = found.R2 * stated.pose->T;
  found.P1 = {focal, 0, (size.width - 1) / 2.0, 0, 0, focal, (size.height - 1) / 2.0, 0, 0, 0, 1, 0};
  found.P2 = found.P1;
  found.P2(0, 3) = focal * baseline[0];
}

// OpenCV turns cameras that are above each other so that columns match, or by 90 degrees.
void check_side_by_side(const StatedCalibration::Pose& pose) {
  if (std::abs(pose.T[1]) <= std::abs(pose.T[0])) return;
  throw UserError(
      fmt::format("{}: the cameras are above each other, {:.4g} against {:.4g} beside; only side by side "
                  "cameras are supported",
                  pose.translation_name, std::abs(pose.T[1]), std::abs(pose.T[0])));
}

}  // namespace

RectifiedPair rectify_pair(const StatedCalibration& stated) {
  const StatedCalibration::Pose& pose = *stated.pose;
  check_side_by_side(pose);
  const Lens& left = stated.left->lens;
  const Lens& right = stated.right->lens;
  const cv::Size size(stated.size.width, stated.size.height);
  cv::Mat r1;
  cv::Mat r2;
  cv::Mat p1;
  cv::Mat p2;
  cv::Mat q;
  try {
    if (stated.model == LensModel::kFisheye) {
      cv::fisheye::stereoRectify(left.camera, left.distortion, right.camera, right.distortion, size, pose.R,
                                 pose.T, r1, r2, p1, p2, q, cv::fisheye::CALIB_ZERO_DISPARITY, size, 0.0,
                                 1.0);
    } else {
      cv::stereoRectify(left.camera, left.distortion, right.camera, right.distortion, size, pose.R, pose.T,
                        r1, r2, p1, p2, q, cv::CALIB_ZERO_DISPARITY, 0.0, size);
    }
  } catch (const cv::Exception& error) {
    throw UserError(fmt::format("{}: OpenCV cannot rectify this calibration: {}", stated.source, error.err));
  }
  RectifiedPair found;
  found.R1 = cv::Matx33d(r1.ptr<double>());
  found.R2 = cv::Matx33d(r2.ptr<double>());
  found.P1 = cv::Matx34d(p1.ptr<double>());
  found.P2 = cv::Matx34d(p2.ptr<double>());
  if (stated.model == LensModel::kFisheye) repair_wide_fisheye(found, stated);
  return found;
}

}  // namespace parallax
