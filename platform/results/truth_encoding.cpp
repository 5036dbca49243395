// SPDX-License-Identifier: Apache-2.0
#include "platform/results/truth_encoding.hpp"

#include <fmt/format.h>

#include <opencv2/core.hpp>

#include "tlm/error.hpp"

namespace parallax {

TruthEncoding truth_encoding(const std::string& text) {
  if (text.empty() || text == "values") return TruthEncoding::kValues;
  if (text == "sintel") return TruthEncoding::kSintel;
  throw UserError(fmt::format("--ground-truth-encoding is '{}', expected values or sintel", excerpt(text)));
}

cv::Mat decode_sintel(const cv::Mat& image, const std::string& path) {
  if (image.depth() != CV_8U || image.channels() < 3) {
    throw UserError(fmt::format(
        "{}: --ground-truth-encoding sintel is for colour images of 8 bits, this one has {} channel{} of {} "
        "bits",
        path, image.channels(), image.channels() == 1 ? "" : "s", 8 * image.elemSize1()));
  }
  constexpr double kRed = 4, kGreen = 1.0 / 64, kBlue = 1.0 / 16384;
  std::vector<cv::Mat> channels;
  cv::split(image, channels);
  for (cv::Mat& channel : channels) channel.convertTo(channel, CV_64F);
  return channels[2] * kRed + channels[1] * kGreen + channels[0] * kBlue;
}

}  // namespace parallax
