// SPDX-License-Identifier: Apache-2.0
#include "platform/results/strip_gif.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "platform/results/result_images.hpp"

namespace parallax {
namespace {

constexpr int kWidestPanel = 320;  // px: two of them make the file's width
constexpr int kHighestPanel = 640;
constexpr double kShortest = 2;      // centiseconds
constexpr double kLongest = 0xFFFF;  // what the format can say

// The palette: greys for the left image, the first of them black as invalid pixels are, then the disparities.
constexpr int kGreys = 64;
constexpr int kFrameColors = 128;

std::uint8_t grey_index(std::uint8_t grey) { return static_cast<std::uint8_t>(grey * kGreys / 256); }

cv::Size panel_size(const cv::Size& frame) {
  const double shrink =
      std::max({1.0, frame.width / double{kWidestPanel}, frame.height / double{kHighestPanel}});
  const auto shrunk = [&](int pixels) { return std::max(1, static_cast<int>(std::lround(pixels / shrink))); };
  return {shrunk(frame.width), shrunk(frame.height)};
}

/// Fewer colours, of the same scale.
ColorScale thinned(const ColorScale& scale) {
  std::vector<cv::Vec3b> colors;
  for (std::size_t i = 0; i < kFrameColors; ++i) {
    colors.push_back(scale.colors()[i * (scale.colors().size() - 1) / (kFrameColors - 1)]);
  }
  return {scale.lowest(), scale.highest(), colors};
}

std::vector<cv::Vec3b> palette_of(const ColorScale& scale) {
  std::vector<cv::Vec3b> palette;
  for (int i = 0; i < kGreys; ++i) {
    const int grey = i * 255 / (kGreys - 1);
    palette.push_back(cv::Vec3b::all(static_cast<std::uint8_t>(grey)));
  }
  palette.insert(palette.end(), scale.colors().begin(), scale.colors().end());
  return palette;
}

/// The nearest entry of the palette for each pixel of a picture.
cv::Mat to_indices(const cv::Mat& picture, const std::vector<cv::Vec3b>& palette) {
  cv::Mat indices(picture.size(), CV_8UC1);
  std::transform(picture.begin<cv::Vec3b>(), picture.end<cv::Vec3b>(), indices.begin<std::uint8_t>(),
                 [&](const cv::Vec3b& pixel) {
                   const auto distance = [&](const cv::Vec3b& color) {
                     const cv::Vec3i difference = cv::Vec3i(pixel) - cv::Vec3i(color);
                     return difference.dot(difference);
                   };
                   const auto nearest = std::min_element(
                       palette.begin(), palette.end(),
                       [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
                   return static_cast<std::uint8_t>(nearest - palette.begin());
                 });
  return indices;
}

}  // namespace

StripGif::StripGif(OutputFile& file, const cv::Size& frame, const ColorScale& scale)
    : panel_(panel_size(frame)),
      scale_(thinned(scale)),
      palette_(palette_of(scale_)),
      legend_(to_indices(draw_legend(disparity_legend(scale_), 2 * panel_.width), palette_)),
      file_(file),
      encoder_({2 * panel_.width, panel_.height + legend_.rows}, palette_) {}

void StripGif::add(const cv::Mat& left, const DisparityView& disparities, double milliseconds) {
  const bool first = waiting_.empty();
  if (!first) write(milliseconds);
  cv::Mat small_left;
  cv::resize(left, small_left, panel_, 0, 0, cv::INTER_AREA);
  waiting_.create(panel_.height, 2 * panel_.width, CV_8UC1);
  for (int y = 0; y < panel_.height; ++y) {
    auto* const out = waiting_.ptr<std::uint8_t>(y);
    const auto* const grey = small_left.ptr<std::uint8_t>(y);
    std::transform(grey, grey + panel_.width, out, grey_index);
    // The nearest pixel, as a mean over the edge of an object is a disparity of nothing.
    const Disparity* const row = disparities.row((2 * y + 1) * disparities.height / (2 * panel_.height));
    for (int x = 0; x < panel_.width; ++x) {
      const Disparity& d = row[(2 * x + 1) * disparities.width / (2 * panel_.width)];
      out[panel_.width + x] = static_cast<std::uint8_t>(d.valid() ? kGreys + scale_.index(in_pixels(d)) : 0);
    }
  }
  if (first) waiting_.push_back(legend_);  // later frames leave it where it is
  since_ = milliseconds;
}

void StripGif::complete() {
  if (!waiting_.empty()) write(since_ + shown_);
  file_.write(encoder_.end());
  file_.close();
}

void StripGif::write(double milliseconds) {
  shown_ = milliseconds - since_;
  const long centiseconds = std::lround(std::clamp(shown_ / 10, kShortest, kLongest));
  file_.write(encoder_.frame(waiting_, static_cast<int>(centiseconds)));
}

}  // namespace parallax
