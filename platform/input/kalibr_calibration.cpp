// SPDX-License-Identifier: Apache-2.0
#include "platform/input/kalibr_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "platform/input/pinhole_camera.hpp"
#include "platform/input/rigid_transform.hpp"

namespace parallax {
namespace {

constexpr const char* kFromNeighbour = "T_cn_cnm1";
constexpr const char* kFromImu = "T_cam_imu";
constexpr const char* kToImu = "T_imu_cam";

std::string camera_name(int number) { return fmt::format("cam{}", number); }

std::optional<cv::Matx44d> from_imu(const YamlEntries& camera) {
  if (camera.has(kFromImu)) return rigid_transform(camera, kFromImu);
  if (camera.has(kToImu)) return rigid_inverse(rigid_transform(camera, kToImu));
  return std::nullopt;
}

// From the axes of the camera before it in the chain.
cv::Matx44d from_neighbour(const YamlEntries& chain, int number) {
  const YamlEntries camera = chain.map(camera_name(number));
  const YamlEntries neighbour = chain.map(camera_name(number - 1));
  if (!camera.has(kFromNeighbour)) {
    const auto here = from_imu(camera), there = from_imu(neighbour);
    if (here && there) return *here * rigid_inverse(*there);
  }
  return rigid_transform(camera, kFromNeighbour);
}

cv::Matx44d from_left_to_right(const YamlEntries& chain, const CameraPair& cameras) {
  const auto [first, last] = std::minmax(cameras.left, cameras.right);
  cv::Matx44d t = cv::Matx44d::eye();
  for (int number = first + 1; number <= last; ++number) t = from_neighbour(chain, number) * t;
  return cameras.left < cameras.right ? t : rigid_inverse(t);
}

}  // namespace

bool is_kalibr_calibration(const TopLevel& file) { return file.has_numbered("cam"); }

StatedCalibration read_kalibr_calibration(const CalibrationRequest& request) {
  const YamlEntries chain(request.files.front());
  const YamlEntries left = chain.map(camera_name(request.cameras.left));
  const YamlEntries right = chain.map(camera_name(request.cameras.right));
  StatedCalibration stated = pinhole_pair(left, right, "distortion_coeffs");
  stated.source = request.source();
  stated.unit = "m";
  stated.pose = pose_of(from_left_to_right(chain, request.cameras), right.where(kFromNeighbour));
  return stated;
}

}  // namespace parallax
