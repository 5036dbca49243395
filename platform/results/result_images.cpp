// SPDX-License-Identifier: Apache-2.0
#include "platform/results/result_images.hpp"

#include <algorithm>
#include <opencv2/core.hpp>
#include <string>

#include "tlm/units.hpp"

namespace parallax {
namespace {

const cv::Vec3b kInvalid(0, 0, 0);
// Neither is near a colour of error_scale().
const cv::Vec3b kInvalidError(230, 140, 60);
const cv::Vec3b kNotScored(110, 110, 110);

/// The picture of a map: `color(pixel, index)` for each pixel.
template <class Color>
cv::Mat picture(const DisparityView& map, const Color& color) {
  using Pixel = decltype(color(*map.pixels, std::size_t{0}));
  cv::Mat_<Pixel> image(map.height, map.width);
  Pixel* const out = image[0];
  for (std::size_t i = 0; i < image.total(); ++i) out[i] = color(map.pixels[i], i);
  return image;
}

cv::Vec3b color_of(const CauseStyle& style) { return {style.rgb[2], style.rgb[1], style.rgb[0]}; }

}  // namespace

cv::Mat disparity_values(const DisparityView& map) {
  return picture(map, [](const Disparity& d, std::size_t) {
    if (!d.valid()) return std::uint16_t{0};
    return static_cast<std::uint16_t>(std::max(1, d.value << (8 - kDisparityFractionBits)));
  });
}

cv::Mat disparity_colors(const DisparityView& map, const ColorScale& scale) {
  return picture(
      map, [&](const Disparity& d, std::size_t) { return d.valid() ? scale.color(in_pixels(d)) : kInvalid; });
}

Legend disparity_legend(const ColorScale& scale) {
  return {LegendScale{"disparity, px", scale}, {{"invalid", kInvalid}}};
}

const std::array<CauseStyle, kCauses>& cause_styles() {
  // Valid pixels in quiet greys, so that the reasons for a gap stand out; hues after Okabe and Ito's palette,
  // which most colour-blind readers can tell apart.
  static const std::array<CauseStyle, kCauses> styles{
      {{Cause::kMatched, "matched", {210, 210, 210}},
       {Cause::kInterpolated, "interpolated", {140, 140, 140}},
       {Cause::kBorder, "border", {0, 0, 0}},
       {Cause::kUniqueness, "uniqueness", {230, 159, 0}},
       {Cause::kConsistency, "consistency", {0, 114, 178}},
       {Cause::kTexture, "texture", {0, 158, 115}},
       {Cause::kSpeckle, "speckle", {204, 121, 167}},
       {Cause::kNoise, "noise", {240, 228, 66}}}};
  return styles;
}

cv::Mat cause_colors(const DisparityView& map) {
  return picture(
      map, [](const Disparity& d, std::size_t) { return color_of(cause_styles().at(index_of(d.cause))); });
}

Legend cause_legend() {
  Legend legend;
  for (const CauseStyle& style : cause_styles()) {
    legend.entries.push_back({std::string(style.name), color_of(style)});
  }
  return legend;
}

cv::Mat cause_labels(const DisparityView& map) {
  return picture(map, [](const Disparity& d, std::size_t) { return static_cast<std::uint8_t>(d.cause); });
}

cv::Mat error_colors(const DisparityView& map, const GroundTruth& truth) {
  if (truth.width != map.width || truth.height != map.height) {
    throw std::invalid_argument("the ground truth is not of the disparity map's size");
  }
  const ColorScale scale = error_scale();
  return picture(map, [&](const Disparity& d, std::size_t i) {
    if (!truth.scored(i)) return kNotScored;
    return d.valid() ? scale.color(truth.error(i, d)) : kInvalidError;
  });
}

Legend error_legend() {
  return {LegendScale{"error, px", error_scale(), true},
          {{"invalid", kInvalidError}, {"not scored", kNotScored}}};
}

}  // namespace parallax
