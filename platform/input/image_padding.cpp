// SPDX-License-Identifier: Apache-2.0
#include "platform/input/image_padding.hpp"

#include <fmt/format.h>

#include <opencv2/core.hpp>

namespace parallax {

cv::Size padded_size(const cv::Size& size, const Granularity& granularity) {
  const auto up = [](int value, int step) { return (value + step - 1) / step * step; };
  return {up(size.width, granularity.width), up(size.height, granularity.height)};
}

StereoImages pad_images(const StereoImages& images, const Granularity& granularity) {
  const auto pad = [&](const cv::Mat& image) -> cv::Mat {
    const cv::Size target = padded_size(image.size(), granularity);
    if (target == image.size()) {
      return image;
    }
    cv::Mat padded;
    cv::copyMakeBorder(image, padded, 0, target.height - image.rows, 0, target.width - image.cols,
                       cv::BORDER_REPLICATE);
    return padded;
  };
  return {pad(images.left), pad(images.right)};
}

cv::Mat crop_image(const cv::Mat& padded, const cv::Size& size) {
  return padded(cv::Rect(cv::Point(0, 0), size)).clone();
}

std::vector<Disparity> crop_disparities(const std::vector<Disparity>& padded, int padded_width,
                                        const cv::Size& size) {
  std::vector<Disparity> cropped;
  cropped.reserve(size.area());
  for (int y = 0; y < size.height; ++y) {
    const auto row = padded.begin() + std::ptrdiff_t{y} * padded_width;
    cropped.insert(cropped.end(), row, row + size.width);
  }
  return cropped;
}

std::string padding_notice(const cv::Size& size, const Granularity& granularity) {
  const cv::Size target = padded_size(size, granularity);
  if (target == size) {
    return {};
  }
  return fmt::format(
      "image size {}x{} is not a multiple of {}x{}: processed as {}x{} by repeating the last column and "
      "row, results are cropped back",
      size.width, size.height, granularity.width, granularity.height, target.width, target.height);
}

}  // namespace parallax
