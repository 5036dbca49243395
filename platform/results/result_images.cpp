// SPDX-License-Identifier: Apache-2.0
#include "platform/results/result_images.hpp"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

namespace parallax {
namespace {

constexpr int kLegendRow = 24;      // px
constexpr int kLegendColumn = 128;  // px: the longest name with its swatch
constexpr double kTextScale = 0.4;  // of OpenCV's 21 px Hershey font

const cv::Scalar kTextColor(255, 255, 255);
const cv::Scalar kLegendBackground(0, 0, 0);

void put_text(cv::Mat& image, const std::string& text, const cv::Point& bottom_left) {
  cv::putText(image, text, bottom_left, cv::FONT_HERSHEY_SIMPLEX, kTextScale, kTextColor, 1, cv::LINE_AA);
}

int text_width(const std::string& text) {
  int baseline = 0;
  return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kTextScale, 1, &baseline).width;
}

/// The colour scale's 256 colours, far to near. The map's darkest blues are left out: they look like black,
/// which means invalid.
cv::Mat color_scale() {
  cv::Mat ramp(1, 256, CV_8UC1);
  for (int i = 0; i < 256; ++i) {
    ramp.at<std::uint8_t>(0, i) = static_cast<std::uint8_t>(24 + i * (255 - 24) / 255);
  }
  cv::Mat colors;
  cv::applyColorMap(ramp, colors, cv::COLORMAP_TURBO);
  return colors;
}

/// Appends `rows` legend rows below the image and returns the whole.
cv::Mat with_legend(const cv::Mat& image, int rows) {
  cv::Mat result;
  cv::copyMakeBorder(image, result, 0, rows * kLegendRow, 0, 0, cv::BORDER_CONSTANT, kLegendBackground);
  return result;
}

}  // namespace

std::vector<unsigned char> encode_png(const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  if (!cv::imencode(".png", image, bytes)) {
    throw std::runtime_error("PNG encoder failed");
  }
  return bytes;
}

std::vector<unsigned char> encode_disparity_png(const DisparityView& map) {
  cv::Mat image(map.height, map.width, CV_16UC1, cv::Scalar(0));
  for (int y = 0; y < map.height; ++y) {
    auto* out = image.ptr<std::uint16_t>(y);
    for (int x = 0; x < map.width; ++x) {
      const Disparity& d = map.row(y)[x];
      if (d.valid()) {
        out[x] = static_cast<std::uint16_t>(std::max(1, d.value << (8 - kDisparityFractionBits)));
      }
    }
  }
  return encode_png(image);
}

std::vector<unsigned char> encode_disparity_color_png(const DisparityView& map, const ColorRange& range) {
  const cv::Mat colors = color_scale();
  const double low = range.lowest * double{1 << kDisparityFractionBits};
  const double span = std::max(1, range.highest - range.lowest) * double{1 << kDisparityFractionBits};
  cv::Mat image(map.height, map.width, CV_8UC3, kLegendBackground);
  for (int y = 0; y < map.height; ++y) {
    auto* out = image.ptr<cv::Vec3b>(y);
    for (int x = 0; x < map.width; ++x) {
      const Disparity& d = map.row(y)[x];
      if (d.valid()) {
        out[x] =
            colors.at<cv::Vec3b>(0, static_cast<int>(std::clamp((d.value - low) / span, 0.0, 1.0) * 255));
      }
    }
  }
  const std::string left = std::to_string(range.lowest) + " px";
  const std::string right = std::to_string(range.highest) + " px, black: invalid";
  const int from = text_width(left) + 12;
  const int to = map.width - text_width(right) - 12;
  if (to - from < 32) {
    return encode_png(image);
  }
  image = with_legend(image, 1);
  cv::Mat bar = image(cv::Rect(from, map.height + 5, to - from, kLegendRow - 10));
  cv::resize(colors, bar, bar.size(), 0, 0, cv::INTER_LINEAR);
  put_text(image, left, {6, map.height + 16});
  put_text(image, right, {to + 6, map.height + 16});
  return encode_png(image);
}

const std::array<CauseStyle, 8>& cause_styles() {
  // Valid pixels in quiet greys, so that the reasons for a gap stand out; hues after Okabe and Ito's palette,
  // which most colour-blind readers can tell apart.
  static const std::array<CauseStyle, 8> styles{{{Cause::kMatched, "matched", {210, 210, 210}},
                                                 {Cause::kInterpolated, "interpolated", {140, 140, 140}},
                                                 {Cause::kBorder, "border", {0, 0, 0}},
                                                 {Cause::kUniqueness, "uniqueness", {230, 159, 0}},
                                                 {Cause::kConsistency, "consistency", {0, 114, 178}},
                                                 {Cause::kTexture, "texture", {0, 158, 115}},
                                                 {Cause::kSpeckle, "speckle", {204, 121, 167}},
                                                 {Cause::kNoise, "noise", {240, 228, 66}}}};
  return styles;
}

std::vector<unsigned char> encode_causes_png(const DisparityView& map) {
  const auto& styles = cause_styles();
  const auto bgr = [&](Cause cause) {
    const auto& rgb = styles.at(static_cast<std::size_t>(cause)).rgb;
    return cv::Vec3b(rgb[2], rgb[1], rgb[0]);
  };
  cv::Mat image(map.height, map.width, CV_8UC3);
  for (int y = 0; y < map.height; ++y) {
    auto* out = image.ptr<cv::Vec3b>(y);
    std::transform(map.row(y), map.row(y) + map.width, out, [&](const Disparity& d) { return bgr(d.cause); });
  }
  const int columns = std::min(map.width / kLegendColumn, static_cast<int>(styles.size()));
  if (columns < 1) {
    return encode_png(image);
  }
  const int count = static_cast<int>(styles.size());
  image = with_legend(image, (count + columns - 1) / columns);
  for (int i = 0; i < count; ++i) {
    const CauseStyle& style = styles[static_cast<std::size_t>(i)];
    const cv::Point corner(i % columns * kLegendColumn + 6, map.height + i / columns * kLegendRow + 5);
    const cv::Rect swatch(corner, cv::Size(14, 14));
    cv::rectangle(image, swatch, cv::Scalar(bgr(style.cause)), cv::FILLED);
    cv::rectangle(image, swatch, kTextColor);  // so that black shows on black
    put_text(image, std::string(style.name), corner + cv::Point(20, 11));
  }
  return encode_png(image);
}

std::vector<unsigned char> encode_cause_labels_png(const DisparityView& map) {
  cv::Mat image(map.height, map.width, CV_8UC1);
  for (int y = 0; y < map.height; ++y) {
    std::transform(map.row(y), map.row(y) + map.width, image.ptr<std::uint8_t>(y),
                   [](const Disparity& d) { return static_cast<std::uint8_t>(d.cause); });
  }
  return encode_png(image);
}

}  // namespace parallax
