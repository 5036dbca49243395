// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/exchanged_sides.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace parallax {
namespace {

constexpr int kWidth = 320;  // px, about what is left of an image
constexpr int kPatch = 9;
constexpr int kStep = 12;

// Of the patch and the one `shift` px away: mean absolute difference.
double difference(const StereoImages& images, const cv::Rect& patch, int shift) {
  const cv::Rect there(patch.x + shift, patch.y, patch.width, patch.height);
  return cv::norm(images.left(patch), images.right(there), cv::NORM_L1) / patch.area();
}

// At a reduced size, without what is brighter or darker over a patch: two cameras differ in that.
cv::Mat reduced(const cv::Mat& image, const cv::Size& size) {
  cv::Mat small, level, detail;
  cv::resize(image, small, size, 0, 0, cv::INTER_AREA);
  cv::blur(small, level, {kPatch, kPatch});
  cv::subtract(small, level, detail, cv::noArray(), CV_16S);
  return detail;
}

int matching_patches(const StereoImages& images, int largest) {
  constexpr double kTexture = 6, kMuchBetter = 0.6;  // grey values; of the differences
  const double scale = std::min(1.0, static_cast<double>(kWidth) / images.left.cols);
  const cv::Size size(std::max(1, cvRound(images.left.cols * scale)),
                      std::max(1, cvRound(images.left.rows * scale)));
  const StereoImages small{reduced(images.left, size), reduced(images.right, size)};
  // Both ways must be open to each patch.
  const int reach = std::min(static_cast<int>(std::ceil(largest * scale)), (size.width - kPatch) / 3);
  int matching = 0;
  for (int y = 0; y + kPatch <= size.height; y += kStep) {
    for (int x = std::max(0, reach); x + kPatch + reach <= size.width; x += kStep) {
      const cv::Rect patch(x, y, kPatch, kPatch);
      cv::Scalar mean, deviation;
      cv::meanStdDev(small.left(patch), mean, deviation);
      if (deviation[0] < kTexture) continue;
      double to_left = std::numeric_limits<double>::max(), to_right = to_left;
      for (int shift = 0; shift <= reach; ++shift) {
        to_left = std::min(to_left, difference(small, patch, -shift));
        to_right = std::min(to_right, difference(small, patch, shift));
      }
      matching += to_left < kMuchBetter * to_right ? 1 : 0;
    }
  }
  return matching;
}

}  // namespace

bool sides_look_exchanged(const StereoImages& given, const StereoImages& exchanged, int largest) {
  constexpr int kEnough = 16, kPlainly = 4;
  const int otherwise = matching_patches(exchanged, largest);
  return otherwise >= kEnough && otherwise >= kPlainly * matching_patches(given, largest);
}

}  // namespace parallax
