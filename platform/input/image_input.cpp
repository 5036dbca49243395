// SPDX-License-Identifier: Apache-2.0
#include "platform/input/image_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "platform/images/image_codecs.hpp"
#include "platform/input/stderr_capture.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

namespace fs = std::filesystem;

std::string size_text(const cv::Mat& image) { return fmt::format("{}x{}", image.cols, image.rows); }

void require_file(const fs::path& path) {
  std::error_code failed;
  const fs::file_status status = fs::status(path, failed);
  if (!fs::exists(status)) {
    throw UserError(fmt::format("image {} does not exist", path.string()));
  }
  if (fs::is_directory(status)) {
    throw UserError(fmt::format("{} is a folder, expected an image", path.string()));
  }
}

cv::Mat decode(const fs::path& path) {
  require_file(path);
  cv::Mat image;
  std::string complaint;
  {
    const StderrCapture capture;
    try {
      image = read_image(path.string());
    } catch (const cv::Exception&) {
      image.release();
    }
    complaint = capture.text();
  }
  // The JPEG decoder fills the missing part of a truncated file with grey and only warns.
  const bool damaged = complaint.find("Corrupt JPEG") != std::string::npos ||
                       complaint.find("Premature end") != std::string::npos;
  if (image.empty() || damaged) {
    throw UserError(
        fmt::format("cannot read image {}: it is damaged, or not a PNG, JPEG, TIFF, BMP, PNM or WebP file",
                    path.string()));
  }
  if (image.depth() != CV_8U && image.depth() != CV_16U) {
    const bool real = image.depth() == CV_16F || image.depth() == CV_32F || image.depth() == CV_64F;
    throw UserError(fmt::format("image {} has {} values, expected unsigned integers of 8 or 16 bits",
                                path.string(), real ? "floating-point" : "signed integer"));
  }
  return image;
}

}  // namespace

ImageInput::ImageInput(std::vector<ImagePair> pairs, const ImageLimits& limits, NoticeSink notice)
    : pairs_(std::move(pairs)), limits_(limits), notice_(std::move(notice)) {
  if (pairs_.empty()) {
    throw UserError("there is no image pair to read");
  }
  for (const ImagePair& pair : pairs_) {
    require_file(pair.left);
    require_file(pair.right);
  }
  load(0);
}

StereoImages ImageInput::load(std::size_t frame) {
  const ImagePair& pair = pairs_.at(frame);
  StereoImages images = read(pair);
  if (width_ == 0) {
    width_ = images.left.cols;
    height_ = images.left.rows;
  }
  if (images.left.cols != width_ || images.left.rows != height_) {
    throw UserError(
        fmt::format("image {} is {}, but the sequence began with {}x{}; all frames must have one size",
                    pair.left.string(), size_text(images.left), width_, height_));
  }
  return images;
}

StereoImages ImageInput::read(const ImagePair& pair) {
  const cv::Mat left = decode(pair.left);
  const cv::Mat right = decode(pair.right);
  if (left.size() != right.size()) {
    throw UserError(fmt::format("the left image {} is {}, the right image {} is {}; both must have one size",
                                pair.left.string(), size_text(left), pair.right.string(), size_text(right)));
  }
  if (left.cols > limits_.width || left.rows > limits_.height) {
    throw UserError(fmt::format("image {} is {}, larger than the largest size {}x{}", pair.left.string(),
                                size_text(left), limits_.width, limits_.height));
  }
  const cv::Mat mono_left = to_mono(left, pair.left);
  const cv::Mat mono_right = to_mono(right, pair.right);
  if (!dropped_bits_ && (left.depth() == CV_16U || right.depth() == CV_16U)) {
    double largest = 0;
    for (const cv::Mat& image : {mono_left, mono_right}) {
      double value = 0;
      cv::minMaxLoc(image, nullptr, &value);
      largest = std::max(largest, image.depth() == CV_16U ? value : 0.0);
    }
    dropped_bits_ = largest <= 4095 ? 4 : 8;
    if (notice_) {
      notice_(fmt::format(
          "16-bit images: the largest value of the first pair is {}, so they are taken as {}-bit and "
          "the lower {} bits are dropped",
          largest, *dropped_bits_ + 8, *dropped_bits_));
    }
  }
  return {to_8_bit(mono_left, pair.left), to_8_bit(mono_right, pair.right)};
}

cv::Mat ImageInput::to_mono(const cv::Mat& image, const fs::path& path) {
  if (image.channels() == 1) {
    return image;
  }
  cv::Mat mono;
  if (image.channels() == 2) {  // grey with transparency
    cv::extractChannel(image, mono, 0);
    return mono;
  }
  if (!said_colour_ && notice_) {
    notice_(fmt::format("colour images ({}) are converted to mono: 0.299 R + 0.587 G + 0.114 B",
                        path.filename().string()));
  }
  said_colour_ = true;
  cv::cvtColor(image, mono, image.channels() == 4 ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGR2GRAY);
  return mono;
}

cv::Mat ImageInput::to_8_bit(const cv::Mat& mono, const fs::path& path) const {
  if (mono.depth() == CV_8U) {
    return mono;
  }
  cv::Mat result(mono.size(), CV_8UC1);
  for (int y = 0; y < mono.rows; ++y) {
    for (int x = 0; x < mono.cols; ++x) {
      const int value = mono.at<std::uint16_t>(y, x) >> *dropped_bits_;
      if (value > 255) {
        throw UserError(
            fmt::format("image {} holds the value {}, but the sequence began with 12-bit values (at most "
                        "4095)",
                        path.string(), mono.at<std::uint16_t>(y, x)));
      }
      result.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(value);
    }
  }
  return result;
}

}  // namespace parallax
