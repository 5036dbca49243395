// SPDX-License-Identifier: Apache-2.0
#include "platform/scene/scene_calibration.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/persistence.hpp>

#include "platform/scene/scene_geometry.hpp"

namespace parallax {
namespace {

constexpr double kTargetOffset =
    34;  // px; the window's 39 less a margin for fixed-point rounding and for cropping

/// Rotation by three small angles in Cayley's form: rational, so the same on every machine; v is half the
/// axis-angle.
cv::Matx33d rotation(const cv::Vec3d& v) {
  const double n = 1 + v.dot(v);
  const cv::Matx33d skew(0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0);
  return cv::Matx33d::eye() + (skew + skew * skew) * (2 / n);
}

/// How one camera differs from the ideal one, at full strength.
struct Imperfection {
  cv::Vec<double, 5> distortion;
  cv::Vec3d half_rotation;    // rad / 2
  double focal, focal_y;      // relative excess
  double centre_x, centre_y;  // shares of the longer image side
};

// Barrel distortion, so that the rectified view lies inside the raw one. Sizes as in a usual 6 mm
// machine-vision lens.
const Imperfection kLeft{
    {-0.130, 0.045, 0.0006, -0.0004, -0.004}, {0.0020, -0.0016, 0.0028}, 0.004, 0.0052, 0.004, -0.003};
const Imperfection kRight{
    {-0.118, 0.036, -0.0005, 0.0007, -0.002}, {-0.0015, 0.0022, -0.0021}, -0.003, -0.0016, -0.005, 0.002};

SceneLens lens(const Imperfection& what, double strength, const SceneFrame& frame, double side) {
  SceneLens result;
  result.camera_matrix = cv::Matx33d(
      frame.focal * (1 + strength * what.focal), 0, frame.cx + strength * what.centre_x * side, 0,
      frame.focal * (1 + strength * what.focal_y), frame.cy + strength * what.centre_y * side, 0, 0, 1);
  result.distortion = what.distortion * strength;
  result.rectifying_rotation = rotation(what.half_rotation * strength);
  return result;
}

cv::Vec2d distort(const cv::Vec2d& p, const cv::Vec<double, 5>& d) {
  const double x = p[0], y = p[1];
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]));
  return {x * radial + 2 * d[2] * x * y + d[3] * (r2 + 2 * x * x),
          y * radial + d[2] * (r2 + 2 * y * y) + 2 * d[3] * x * y};
}

void set_cameras(SceneCalibration& c, const SceneFrame& frame, double strength) {
  const double side = std::max(c.width, c.height);
  c.left = lens(kLeft, strength, frame, side);
  c.right = lens(kRight, strength, frame, side);
  const cv::Matx33d to_right = c.right.rectifying_rotation.t();
  c.r = to_right * c.left.rectifying_rotation;
  c.t = to_right * cv::Vec3d(-frame.baseline, 0, 0);
}

}  // namespace

cv::Vec2d SceneLens::project(const cv::Vec2d& rectified_ray) const {
  const cv::Vec3d ray = rectifying_rotation.t() * cv::Vec3d(rectified_ray[0], rectified_ray[1], 1);
  const cv::Vec2d p = distort({ray[0] / ray[2], ray[1] / ray[2]}, distortion);
  return {camera_matrix(0, 0) * p[0] + camera_matrix(0, 2), camera_matrix(1, 1) * p[1] + camera_matrix(1, 2)};
}

cv::Vec2d SceneLens::unproject(const cv::Vec2d& raw_pixel) const {
  const cv::Vec2d seen((raw_pixel[0] - camera_matrix(0, 2)) / camera_matrix(0, 0),
                       (raw_pixel[1] - camera_matrix(1, 2)) / camera_matrix(1, 1));
  cv::Vec2d p = seen;
  for (int i = 0; i < 100; ++i) {
    const cv::Vec2d error = seen - distort(p, distortion);
    p += error;
    if (std::abs(error[0]) + std::abs(error[1]) < 1e-13) {
      break;
    }
  }
  const cv::Vec3d ray = rectifying_rotation * cv::Vec3d(p[0], p[1], 1);
  return {ray[0] / ray[2], ray[1] / ray[2]};
}

double SceneCalibration::largest_offset() const {
  constexpr int kSteps = 32;
  double largest = 0;
  for (int j = 0; j <= kSteps; ++j) {
    for (int i = 0; i <= kSteps; ++i) {
      const cv::Vec2d pixel((width - 1) * i / double{kSteps}, (height - 1) * j / double{kSteps});
      const cv::Vec2d ray((pixel[0] - p1(0, 2)) / p1(0, 0), (pixel[1] - p1(1, 2)) / p1(1, 1));
      for (const SceneLens* camera : {&left, &right}) {
        const cv::Vec2d offset = camera->project(ray) - pixel;
        largest = std::max({largest, std::abs(offset[0]), std::abs(offset[1])});
      }
    }
  }
  return largest;
}

SceneCalibration scene_calibration(const SceneConfig& config) {
  const SceneFrame frame = scene_frame(config);
  SceneCalibration c;
  c.width = config.width;
  c.height = config.height;
  c.disparities = config.disparities;
  c.rectified = !config.distortion;
  c.p1 = cv::Matx34d(frame.focal, 0, frame.cx, 0, 0, frame.focal, frame.cy, 0, 0, 0, 1, 0);
  c.p2 = c.p1;
  c.p2(0, 3) = -frame.focal * frame.baseline;
  c.q =
      cv::Matx44d(1, 0, 0, -frame.cx, 0, 1, 0, -frame.cy, 0, 0, 0, frame.focal, 0, 0, 1 / frame.baseline, 0);
  double strength = config.distortion ? 1 : 0;
  set_cameras(c, frame, strength);
  for (double offset = c.largest_offset(); offset > kTargetOffset; offset = c.largest_offset()) {
    strength *= 0.99 * kTargetOffset / offset;
    set_cameras(c, frame, strength);
  }
  return c;
}

std::string to_yaml(const SceneCalibration& c) {
  cv::FileStorage file(".yml",
                       cv::FileStorage::WRITE | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML);
  file << "source"
       << "built-in scene, exact";
  file << "camera_model" << (c.rectified ? "rectified" : "pinhole_radtan");
  file << "T_unit"
       << "m";
  file << "image_width" << c.width << "image_height" << c.height << "num_disparities" << c.disparities;
  const auto put = [&](const char* name, const auto& matrix) { file << name << cv::Mat(matrix); };
  put("K1", c.left.camera_matrix);
  put("D1", c.left.distortion.t());
  put("K2", c.right.camera_matrix);
  put("D2", c.right.distortion.t());
  put("R", c.r);
  put("T", c.t);
  put("R1", c.left.rectifying_rotation);
  put("R2", c.right.rectifying_rotation);
  put("P1", c.p1);
  put("P2", c.p2);
  put("Q", c.q);
  return file.releaseAndGetString();
}

}  // namespace parallax
