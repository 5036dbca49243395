// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/difference_image.hpp"

#include <algorithm>
#include <opencv2/core.hpp>

#include "platform/cosim/token_comparison.hpp"

namespace parallax {
namespace {

constexpr int kFaintest = 80;  // red of a pixel of which one value in many differs
constexpr int kFull = 255;

cv::Point pixel_of(const ValuePlace& place) {
  return {static_cast<int>(place.column), static_cast<int>(place.row)};
}

}  // namespace

cv::Mat difference_image(const VectorManifest& manifest, const VectorStream& stream,
                         const TokenWords& expected, const TokenWords& got) {
  if (stream.shape.row_tokens == 0 || stream.frame_tokens == 0) return {};
  const std::uint64_t missing_from = std::min(got.size(), expected.size());
  std::int64_t frame = missing_from < expected.size()
                           ? static_cast<std::int64_t>(missing_from / stream.frame_tokens)
                           : manifest.frames;
  cv::Mat values(manifest.height, manifest.width, CV_32S, cv::Scalar(0));  // that differ, of each pixel
  bool any = false;
  for_each_difference(stream, expected, got, [&](std::uint64_t token, std::size_t field) {
    const ValuePlace place = manifest.place(stream, token, field);
    if (!any && place.frame <= frame) {
      any = true;
      frame = place.frame;
    }
    if (place.frame == frame) ++values.at<int>(pixel_of(place));
  });
  if (frame == manifest.frames) return {};
  double most = 1;
  cv::minMaxLoc(values, nullptr, &most);
  cv::Mat image(values.size(), CV_8UC3, cv::Scalar::all(0));
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.cols; ++column) {
      const int differ = values.at<int>(row, column);
      if (differ == 0) continue;
      const int red = kFaintest + (kFull - kFaintest) * differ / static_cast<int>(most);
      image.at<cv::Vec3b>(row, column)[2] = static_cast<std::uint8_t>(red);
    }
  }
  const std::uint64_t end =
      std::min<std::uint64_t>(expected.size(), (static_cast<std::uint64_t>(frame) + 1) * stream.frame_tokens);
  const std::size_t fields = stream.shape.format.all().size();
  for (std::uint64_t token = missing_from; token < end; ++token) {
    for (std::size_t field = 0; field < fields; ++field) {
      image.at<cv::Vec3b>(pixel_of(manifest.place(stream, token, field)))[0] = kFull;
    }
  }
  return image;
}

}  // namespace parallax
