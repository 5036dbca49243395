// SPDX-License-Identifier: Apache-2.0
#include "platform/input/middlebury_calibration.hpp"

#include <fmt/format.h>

#include <cmath>

#include "platform/input/keyed_lines.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr double kOffsetAgreement = 0.1;  // px

}  // namespace

bool is_middlebury_calibration(const TopLevel& file) {
  return file.value("cam0").rfind('[', 0) == 0 || file.value("cam1").rfind('[', 0) == 0 ||
         (file.has("doffs") && file.has("baseline"));
}

StatedCalibration read_middlebury_calibration(const CalibrationRequest& request) {
  const KeyedLines file(request.files.front(), '=');
  StatedCalibration stated;
  stated.source = request.source();
  stated.model = LensModel::kRectified;
  stated.unit = "mm";
  stated.size =
      file.has("width") || file.has("height")
          ? image_size(file.number("width"), file.number("height"), file.where("width") + ", height")
          : request.images;
  StatedCalibration::StatedLens left;
  StatedCalibration::StatedLens right;
  left.camera_name = file.where("cam0");
  right.camera_name = file.where("cam1");
  left.lens.camera = cv::Matx33d(file.numbers("cam0", 9).data());
  right.lens.camera = cv::Matx33d(file.numbers("cam1", 9).data());
  const double offset = right.lens.camera(0, 2) - left.lens.camera(0, 2);
  if (file.has("doffs") && !(std::abs(file.number("doffs") - offset) <= kOffsetAgreement)) {
    throw UserError(fmt::format("{}: {}, but the principal points of cam1 and cam0 are {} px apart",
                                file.where("doffs"), file.number("doffs"), offset));
  }
  stated.left = left;
  stated.right = right;
  stated.pose = {file.where("baseline"), file.where("baseline"), cv::Matx33d::eye(),
                 cv::Vec3d(-file.number("baseline"), 0, 0)};
  return stated;
}

}  // namespace parallax
