// SPDX-License-Identifier: Apache-2.0
#include "platform/input/kalibr_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "platform/input/yaml_entries.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr const char* kFromNeighbour = "T_cn_cnm1";
constexpr const char* kFromImu = "T_cam_imu";
constexpr double kLastRow = 1e-6;  // of a rigid transform: 0 0 0 1

std::string camera_name(int number) { return fmt::format("cam{}", number); }

ImageSize resolution(const YamlEntries& camera) {
  const std::vector<double> size = camera.matrix("resolution", 1, 2);
  return image_size(size[0], size[1], camera.where("resolution"));
}

LensModel kalibr_model(const YamlEntries& camera) {
  const std::string projection = camera.text("camera_model");
  if (projection != "pinhole") {
    throw UserError(
        fmt::format("{}: \"{}\" is not supported, only pinhole", camera.where("camera_model"), projection));
  }
  const std::string name = camera.text("distortion_model");
  if (name == "none") return LensModel::kPinhole;
  if (const std::optional<LensModel> model = distortion_model(name)) return *model;
  throw UserError(fmt::format("{}: \"{}\" is not supported, only radtan, equidistant and none",
                              camera.where("distortion_model"), name));
}

StatedCalibration::StatedLens kalibr_lens(const YamlEntries& camera) {
  const std::vector<double> f = camera.matrix("intrinsics", 1, 4);
  StatedCalibration::StatedLens lens;
  lens.camera_name = camera.where("intrinsics");
  lens.distortion_name = camera.where("distortion_coeffs");
  lens.lens.camera = {f[0], 0, f[2], 0, f[1], f[3], 0, 0, 1};
  if (camera.text("distortion_model") == "none") {
    lens.lens.distortion.assign(4, 0);
  } else {
    lens.lens.distortion = camera.numbers("distortion_coeffs");
  }
  return lens;
}

cv::Matx44d rigid(const YamlEntries& camera, const std::string& name) {
  const cv::Matx44d t(camera.matrix(name, 4, 4).data());
  if (std::abs(t(3, 0)) + std::abs(t(3, 1)) + std::abs(t(3, 2)) + std::abs(t(3, 3) - 1) > kLastRow) {
    throw UserError(fmt::format("{}: the last row is {}, {}, {}, {}; that of a transform is 0, 0, 0, 1",
                                camera.where(name), t(3, 0), t(3, 1), t(3, 2), t(3, 3)));
  }
  check_rotation(t.get_minor<3, 3>(0, 0), camera.where(name));
  return t;
}

// Of a rotation and a translation, without the errors that inverting the digits of a file adds.
cv::Matx44d rigid_inverse(const cv::Matx44d& t) {
  const cv::Matx33d r = t.get_minor<3, 3>(0, 0).t();
  const cv::Vec3d p = r * cv::Vec3d(t(0, 3), t(1, 3), t(2, 3));
  return {r(0, 0), r(0, 1), r(0, 2), -p[0], r(1, 0), r(1, 1), r(1, 2), -p[1],
          r(2, 0), r(2, 1), r(2, 2), -p[2], 0,       0,       0,       1};
}

// From the axes of the camera before it in the chain.
cv::Matx44d from_neighbour(const YamlEntries& chain, int number) {
  const YamlEntries camera = chain.map(camera_name(number));
  const YamlEntries neighbour = chain.map(camera_name(number - 1));
  if (camera.has(kFromNeighbour) || !camera.has(kFromImu) || !neighbour.has(kFromImu)) {
    return rigid(camera, kFromNeighbour);
  }
  return rigid(camera, kFromImu) * rigid_inverse(rigid(neighbour, kFromImu));
}

cv::Matx44d from_left_to_right(const YamlEntries& chain, const CameraPair& cameras) {
  const auto [first, last] = std::minmax(cameras.left, cameras.right);
  cv::Matx44d t = cv::Matx44d::eye();
  for (int number = first + 1; number <= last; ++number) t = from_neighbour(chain, number) * t;
  return cameras.left < cameras.right ? t : rigid_inverse(t);
}

void check_one_kind(const YamlEntries& left, const YamlEntries& right) {
  const ImageSize a = resolution(left);
  const ImageSize b = resolution(right);
  if (a.width != b.width || a.height != b.height) {
    throw UserError(fmt::format("{}: {}x{}, but the left camera has {}x{}; those of a pair have one size",
                                right.where("resolution"), b.width, b.height, a.width, a.height));
  }
  if (kalibr_model(left) != kalibr_model(right)) {
    throw UserError(fmt::format("{}: {}, but the left camera has {}; both lenses of a pair are of one model",
                                right.where("distortion_model"), right.text("distortion_model"),
                                left.text("distortion_model")));
  }
}

}  // namespace

bool is_kalibr_calibration(const TopLevel& file) { return file.has_numbered("cam"); }

StatedCalibration read_kalibr_calibration(const CalibrationRequest& request) {
  const YamlEntries chain(request.files.front());
  const YamlEntries left = chain.map(camera_name(request.cameras.left));
  const YamlEntries right = chain.map(camera_name(request.cameras.right));
  StatedCalibration stated;
  stated.source = request.source();
  stated.model = kalibr_model(left);
  stated.size = resolution(left);
  stated.unit = "m";
  check_one_kind(left, right);
  stated.left = kalibr_lens(left);
  stated.right = kalibr_lens(right);
  const cv::Matx44d t = from_left_to_right(chain, request.cameras);
  const std::string name = right.where(kFromNeighbour);
  stated.pose = {name, name, t.get_minor<3, 3>(0, 0), cv::Vec3d(t(0, 3), t(1, 3), t(2, 3))};
  return stated;
}

}  // namespace parallax
