// SPDX-License-Identifier: Apache-2.0
#include "platform/input/euroc_calibration.hpp"

#include <fmt/format.h>

#include "platform/input/pinhole_camera.hpp"
#include "platform/input/rigid_transform.hpp"
#include "tlm/error.hpp"

namespace parallax {

bool is_euroc_calibration(const TopLevel& file) { return file.has("T_BS") && file.has("intrinsics"); }

StatedCalibration read_euroc_calibration(const CalibrationRequest& request) {
  if (request.files.size() != 2) {
    throw UserError(
        fmt::format("{}: a sensor.yaml of EuRoC is of one camera: a pair is two files, left and right",
                    request.source()));
  }
  const YamlEntries left(request.files[0]);
  const YamlEntries right(request.files[1]);
  StatedCalibration stated = pinhole_pair(left, right, "distortion_coefficients");
  stated.source = request.source();
  stated.unit = "m";
  stated.pose = pose_of(rigid_inverse(rigid_transform(right, "T_BS")) * rigid_transform(left, "T_BS"),
                        right.where("T_BS"));
  return stated;
}

}  // namespace parallax
