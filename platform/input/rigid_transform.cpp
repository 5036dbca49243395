// SPDX-License-Identifier: Apache-2.0
#include "platform/input/rigid_transform.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tlm/error.hpp"

namespace parallax {

cv::Matx44d rigid_transform(const YamlEntries& entries, const std::string& name) {
  constexpr double kLastRow = 1e-6;
  const cv::Matx44d t(entries.matrix(name, 4, 4).data());
  if (std::abs(t(3, 0)) + std::abs(t(3, 1)) + std::abs(t(3, 2)) + std::abs(t(3, 3) - 1) > kLastRow) {
    throw UserError(fmt::format("{}: the last row is {}, {}, {}, {}; that of a transform is 0, 0, 0, 1",
                                entries.where(name), t(3, 0), t(3, 1), t(3, 2), t(3, 3)));
  }
  check_rotation(t.get_minor<3, 3>(0, 0), entries.where(name));
  return t;
}

cv::Matx44d rigid_inverse(const cv::Matx44d& t) {
  const cv::Matx33d r = t.get_minor<3, 3>(0, 0).t();
  const cv::Vec3d p = r * cv::Vec3d(t(0, 3), t(1, 3), t(2, 3));
  return {r(0, 0), r(0, 1), r(0, 2), -p[0], r(1, 0), r(1, 1), r(1, 2), -p[1],
          r(2, 0), r(2, 1), r(2, 2), -p[2], 0,       0,       0,       1};
}

StatedCalibration::Pose pose_of(const cv::Matx44d& t, const std::string& name) {
  return {name, name, t.get_minor<3, 3>(0, 0), cv::Vec3d(t(0, 3), t(1, 3), t(2, 3))};
}

}  // namespace parallax
