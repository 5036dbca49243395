// SPDX-License-Identifier: Apache-2.0
#include "platform/input/kitti_raw_calibration.hpp"

#include <fmt/format.h>

#include "platform/input/keyed_lines.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

std::string of_camera(const char* name, int number) { return fmt::format("{}_{:02}", name, number); }

bool same_size(const ImageSize& a, const ImageSize& b) { return a.width == b.width && a.height == b.height; }

// That of both cameras; none when the file does not state it.
ImageSize pair_size(const KeyedLines& file, const char* name, const CameraPair& cameras) {
  const auto read = [&file, name](int number) {
    const std::string key = of_camera(name, number);
    if (!file.has(key)) return ImageSize{};
    const std::vector<double> size = file.numbers(key, 2);
    return image_size(size[0], size[1], file.where(key));
  };
  const ImageSize left = read(cameras.left);
  const ImageSize right = read(cameras.right);
  if (!same_size(left, right)) {
    throw UserError(fmt::format("{}: {}x{}, but {} is {}x{}; the images of a pair have one size",
                                file.where(of_camera(name, cameras.right)), right.width, right.height,
                                of_camera(name, cameras.left), left.width, left.height));
  }
  return left;
}

StatedCalibration::StatedLens raw_lens(const KeyedLines& file, int number) {
  StatedCalibration::StatedLens lens;
  const std::string camera = of_camera("K", number);
  const std::string distortion = of_camera("D", number);
  lens.camera_name = file.where(camera);
  lens.distortion_name = file.where(distortion);
  lens.lens.camera = cv::Matx33d(file.numbers(camera, 9).data());
  lens.lens.distortion = file.numbers(distortion, 5);
  return lens;
}

StatedCalibration::Rotations rotations(const KeyedLines& file, const CameraPair& cameras) {
  const std::string left = of_camera("R_rect", cameras.left);
  const std::string right = of_camera("R_rect", cameras.right);
  return {file.where(left), file.where(right), cv::Matx33d(file.numbers(left, 9).data()),
          cv::Matx33d(file.numbers(right, 9).data())};
}

// Whether the file rectifies this pair, wholly or in part.
bool states_rectification(const KeyedLines& file, const CameraPair& cameras) {
  for (const int number : {cameras.left, cameras.right}) {
    if (file.has(of_camera("R_rect", number)) || file.has(of_camera("P_rect", number))) return true;
  }
  return false;
}

// x_camera = R x_0 + T of each camera, so that x_right = R_right R_left^t (x_left - T_left) + T_right.
StatedCalibration::Pose pose(const KeyedLines& file, const CameraPair& cameras) {
  const auto rotation = [&file](int number) {
    const std::string key = of_camera("R", number);
    const cv::Matx33d r(file.numbers(key, 9).data());
    check_rotation(r, file.where(key));
    return r;
  };
  const auto translation = [&file](int number) {
    return cv::Vec3d(file.numbers(of_camera("T", number), 3).data());
  };
  const cv::Matx33d r = rotation(cameras.right) * rotation(cameras.left).t();
  return {file.where(of_camera("R", cameras.right)), file.where(of_camera("T", cameras.right)), r,
          translation(cameras.right) - r * translation(cameras.left)};
}

}  // namespace

bool is_kitti_raw_calibration(const TopLevel& file) {
  return file.has_numbered("P_rect_") || file.has_numbered("S_rect_") ||
         (file.has_numbered("K_") && file.has_numbered("D_"));
}

StatedCalibration read_kitti_raw_calibration(const CalibrationRequest& request) {
  const KeyedLines file(request.files.front(), ':');
  const CameraPair& cameras = request.cameras;
  const ImageSize raw = pair_size(file, "S", cameras);
  const ImageSize rectified = pair_size(file, "S_rect", cameras);
  const ImageSize& images = request.images;
  StatedCalibration stated;
  stated.source = request.source();
  stated.unit = "m";
  if (!states_rectification(file, cameras)) {
    stated.size = raw.width > 0 ? raw : images;
    stated.left = raw_lens(file, cameras.left);
    stated.right = raw_lens(file, cameras.right);
    stated.pose = pose(file, cameras);
    return stated;
  }
  const std::string left = of_camera("P_rect", cameras.left);
  const std::string right = of_camera("P_rect", cameras.right);
  stated.projections = {fmt::format("{}, {}", file.where(left), right),
                        cv::Matx34d(file.numbers(left, 12).data()),
                        cv::Matx34d(file.numbers(right, 12).data())};
  if (raw.width > 0 && (images.width == 0 || same_size(images, raw))) {
    stated.size = raw;
    stated.left = raw_lens(file, cameras.left);
    stated.right = raw_lens(file, cameras.right);
    stated.rotations = rotations(file, cameras);
    return stated;
  }
  stated.model = LensModel::kRectified;
  stated.size = rectified.width > 0 ? rectified : images;
  if (raw.width > 0 && rectified.width > 0 && !same_size(images, rectified)) {
    throw UserError(
        fmt::format("{}: the calibration is for raw images of {}x{} or rectified ones of {}x{}, these "
                    "have {}x{}",
                    stated.source, raw.width, raw.height, rectified.width, rectified.height, images.width,
                    images.height));
  }
  return stated;
}

}  // namespace parallax
