// SPDX-License-Identifier: Apache-2.0
#include "platform/input/stated_calibration.hpp"

#include <fmt/format.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "platform/input/rectify_pair.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr int kLargestSide = 65535;      // px
constexpr double kPoseAgreement = 0.02;  // of the baseline: T against the projections
constexpr double kLargestTurn = 1e-3;    // rad between the cameras of a rectified pair: 1 px at 1000 px

cv::Matx34d projection(const cv::Matx33d& camera, const cv::Vec3d& offset) {
  cv::Matx34d p = cv::Matx34d::zeros();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) p(row, column) = camera(row, column);
    p(row, 3) = camera(row, row) * offset[row];
  }
  return p;
}

void set_projections(Calibration& calibration, const StereoGeometry& g) {
  const cv::Matx33d left(g.focal_x, 0, g.cx_left, 0, g.focal_y, g.cy, 0, 0, 1);
  calibration.P1 = projection(left, {0, 0, 0});
  calibration.P2 = calibration.P1;
  calibration.P2(0, 2) = g.cx_right;
  calibration.P2(0, 3) = -g.focal_x * g.baseline;
}

// T and R must say of the cameras what the projections and rotations do.
void check_pose(const StatedCalibration& stated, double baseline) {
  const StatedCalibration::Pose& pose = *stated.pose;
  const double apart = stated.rotations ? -(stated.rotations->R2 * pose.T)[0] : cv::norm(pose.T);
  if (!(std::abs(apart - baseline) <= kPoseAgreement * baseline)) {
    throw UserError(
        fmt::format("{}: contradicts the projections: it puts the right camera {:.4g} to the right of the "
                    "left one, they put "
                    "it {:.4g}; is one of them in another unit?",
                    pose.translation_name, apart, baseline));
  }
  if (stated.rotations &&
      !(cv::norm(stated.rotations->R2 * pose.R - stated.rotations->R1, cv::NORM_INF) <= kRotationTolerance)) {
    throw UserError(fmt::format("{}: contradicts R1 and R2: R2 R is not R1", pose.rotation_name));
  }
}

void complete_rectified(const StatedCalibration& stated, Calibration& c) {
  std::string name;
  if (stated.projections) {
    name = stated.projections->name;
    c.P1 = stated.projections->P1;
    c.P2 = stated.projections->P2;
  } else if (stated.left && stated.right && stated.pose) {
    name = stated.pose->translation_name;
    if (cv::norm(stated.pose->R - cv::Matx33d::eye(), cv::NORM_INF) > kLargestTurn) {
      throw UserError(
          fmt::format("{}: turns the right camera against the left one, but the images are rectified",
                      stated.pose->rotation_name));
    }
    check_camera(stated.left->lens.camera, stated.left->camera_name);
    check_camera(stated.right->lens.camera, stated.right->camera_name);
    c.P1 = projection(stated.left->lens.camera, {0, 0, 0});
    c.P2 = projection(stated.right->lens.camera, stated.pose->T);
  } else if (stated.reprojection) {
    c.geometry = geometry_of(stated.reprojection->Q, stated.reprojection->name);
    set_projections(c, *c.geometry);
    return;
  } else {
    return;
  }
  check_projections(c.P1, c.P2, name);
  c.geometry = geometry_of(c.P1, c.P2);
}

void complete_raw(const StatedCalibration& stated, Calibration& c) {
  for (const auto* side : {&stated.left, &stated.right}) {
    check_camera((*side)->lens.camera, (*side)->camera_name);
    check_distortion((*side)->lens.distortion, stated.model, (*side)->distortion_name);
  }
  c.left = stated.left->lens;
  c.right = stated.right->lens;
  if (stated.rotations && stated.projections) {
    check_rotation(stated.rotations->R1, stated.rotations->left_name);
    check_rotation(stated.rotations->R2, stated.rotations->right_name);
    c.R1 = stated.rotations->R1;
    c.R2 = stated.rotations->R2;
    c.P1 = stated.projections->P1;
    c.P2 = stated.projections->P2;
    check_projections(c.P1, c.P2, stated.projections->name);
  } else {
    const RectifiedPair found = rectify_pair(stated);
    c.R1 = found.R1;
    c.R2 = found.R2;
    c.P1 = found.P1;
    c.P2 = found.P2;
    check_projections(c.P1, c.P2, stated.source + ": the rectification of R and T");
  }
  c.geometry = geometry_of(c.P1, c.P2);
}

}  // namespace

ImageSize image_size(double width, double height, const std::string& where) {
  const auto side = [](double value) {
    return value >= 1 && value <= kLargestSide && std::floor(value) == value;
  };
  if (!side(width) || !side(height)) {
    throw UserError(fmt::format("{}: {}x{} is not an image size", where, width, height));
  }
  return {static_cast<int>(width), static_cast<int>(height)};
}

Calibration complete(const StatedCalibration& stated) {
  if (stated.size.width == 0) {
    throw UserError(fmt::format("{}: states no image size; give it with --size", stated.source));
  }
  Calibration c;
  c.source = stated.source;
  c.model = stated.model;
  c.size = stated.size;
  c.unit = stated.unit;
  if (stated.pose) {
    check_rotation(stated.pose->R, stated.pose->rotation_name);
    if (cv::norm(stated.pose->T) == 0) {
      throw UserError(stated.pose->translation_name + ": the baseline is zero");
    }
  }
  if (stated.model == LensModel::kRectified) {
    complete_rectified(stated, c);
  } else {
    complete_raw(stated, c);
  }
  // Where the rectification is computed, Q is that of another one.
  if (c.geometry && stated.reprojection && (stated.projections || c.model == LensModel::kRectified)) {
    check_same(*c.geometry, geometry_of(stated.reprojection->Q, stated.reprojection->name),
               stated.reprojection->name);
  }
  if (c.geometry && stated.pose && stated.projections) check_pose(stated, c.geometry->baseline);
  return c;
}

}  // namespace parallax
