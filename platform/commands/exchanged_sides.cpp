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

// Of the patch with its upper left corner at (x, y) and the one `shift` px away: mean absolute difference.
double difference(const cv::Mat& left, const cv::Mat& right, const cv::Rect& patch, int shift, int row) {
  const cv::Rect there(patch.x + shift, patch.y + row, patch.width, patch.height);
  return cv::norm(left(patch), right(there), cv::NORM_L1) / patch.area();
}

}  // namespace

bool sides_look_exchanged(const cv::Mat& left, const cv::Mat& right, int largest, int rows) {
  const double scale = std::min(1.0, static_cast<double>(kWidth) / left.cols);
  const cv::Size size(std::max(1, cvRound(left.cols * scale)), std::max(1, cvRound(left.rows * scale)));
  cv::Mat small_left, small_right;
  cv::resize(left, small_left, size, 0, 0, cv::INTER_AREA);
  cv::resize(right, small_right, size, 0, 0, cv::INTER_AREA);
  // Both ways must be open to each patch.
  const int reach = std::min(static_cast<int>(std::ceil(largest * scale)), (size.width - kPatch) / 3);
  const int row_reach = static_cast<int>(std::ceil(rows * scale));
  constexpr double kTexture = 6, kMuchBetter = 0.6;  // grey values; of the differences
  constexpr int kEnough = 16, kPlainly = 4;
  int as_given = 0, exchanged = 0;
  for (int y = row_reach; y + kPatch + row_reach <= size.height; y += kStep) {
    for (int x = reach; x + kPatch + reach <= size.width; x += kStep) {
      const cv::Rect patch(x, y, kPatch, kPatch);
      cv::Scalar mean, deviation;
      cv::meanStdDev(small_left(patch), mean, deviation);
      if (deviation[0] < kTexture) continue;
      double to_left = std::numeric_limits<double>::max(), to_right = to_left;
      for (int row = -row_reach; row <= row_reach; ++row) {
        for (int shift = 0; shift <= reach; ++shift) {
          to_left = std::min(to_left, difference(small_left, small_right, patch, -shift, row));
          to_right = std::min(to_right, difference(small_left, small_right, patch, shift, row));
        }
      }
      as_given += to_left < kMuchBetter * to_right ? 1 : 0;
      exchanged += to_right < kMuchBetter * to_left ? 1 : 0;
    }
  }
  return exchanged >= kEnough && exchanged >= kPlainly * as_given;
}

}  // namespace parallax
