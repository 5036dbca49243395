// SPDX-License-Identifier: Apache-2.0
#include "platform/input/kitti_calibration.hpp"

#include <fmt/format.h>

#include "platform/input/keyed_lines.hpp"

namespace parallax {

bool is_kitti_calibration(const TopLevel& file) {
  for (const char* name : {"P0", "P1", "P2", "P3"}) {
    if (file.has_number(name)) return true;
  }
  return false;
}

StatedCalibration read_kitti_calibration(const CalibrationRequest& request) {
  const KeyedLines file(request.files.front(), ':');
  const std::string left = fmt::format("P{}", request.cameras.left);
  const std::string right = fmt::format("P{}", request.cameras.right);
  StatedCalibration stated;
  stated.source = request.source();
  stated.model = LensModel::kRectified;
  stated.size = request.images;
  stated.unit = "m";
  stated.projections = {fmt::format("{}, {}", file.where(left), right),
                        cv::Matx34d(file.numbers(left, 12).data()),
                        cv::Matx34d(file.numbers(right, 12).data())};
  return stated;
}

}  // namespace parallax
