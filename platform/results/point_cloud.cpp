// SPDX-License-Identifier: Apache-2.0
#include "platform/results/point_cloud.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

namespace parallax {
namespace {

void put_float(std::vector<unsigned char>& out, float value) {
  std::uint32_t bits = 0;
  static_assert(sizeof bits == sizeof value);
  std::memcpy(&bits, &value, sizeof bits);
  for (int shift = 0; shift < 32; shift += 8) {
    out.push_back((bits >> shift) & 0xFFu);
  }
}

}  // namespace

std::vector<unsigned char> encode_point_cloud_ply(const DisparityView& map, const cv::Mat& left,
                                                  const cv::Matx44d& q) {
  if (left.type() != CV_8UC1 || left.cols != map.width || left.rows != map.height) {
    throw std::invalid_argument("the image of a point cloud is not 8-bit mono of the disparity map's size");
  }
  std::vector<unsigned char> vertices;
  std::size_t count = 0;
  std::size_t behind = 0;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const Disparity& pixel = map.row(y)[x];
      if (!pixel.valid()) {
        continue;
      }
      const cv::Vec4d h = q * cv::Vec4d(x, y, in_pixels(pixel), 1);
      const cv::Vec3f point(static_cast<float>(h[0] / h[3]), static_cast<float>(h[1] / h[3]),
                            static_cast<float>(h[2] / h[3]));
      if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2])) {
        continue;
      }
      if (!(point[2] > 0)) {
        ++behind;
        continue;
      }
      for (int axis = 0; axis < 3; ++axis) {
        put_float(vertices, point[axis]);
      }
      vertices.insert(vertices.end(), 3, left.at<std::uint8_t>(y, x));
      ++count;
    }
  }
  const std::string left_out =
      behind == 0 ? ""
                  : fmt::format("comment left out: {} pixels whose points lie behind the camera\n", behind);
  const std::string header = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment unit: that of the calibration\n"
      "comment axes of the left camera: x right, y down, z forward\n{}element vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
      left_out, count);
  vertices.insert(vertices.begin(), header.begin(), header.end());
  return vertices;
}

}  // namespace parallax
