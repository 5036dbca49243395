// SPDX-License-Identifier: Apache-2.0
#include "platform/input/image_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "platform/images/image_file.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

namespace fs = std::filesystem;

// `pixels`: the image, if it is in memory.
cv::Mat decode(const fs::path& path, const cv::Mat& pixels, const ImageLimits& limits) {
  const auto check = [&](const cv::Size& size) {
    if (size.width <= limits.width && size.height <= limits.height) return;
    throw UserError(fmt::format("image {} is {}, larger than the largest size {}x{}", path.string(),
                                size_text(size), limits.width, limits.height));
  };
  if (!pixels.empty()) check(pixels.size());
  cv::Mat image = pixels.empty() ? read_image_file(path.string(), "image", check) : pixels;
  if (image.depth() != CV_8U && image.depth() != CV_16U) {
    const bool real = image.depth() == CV_16F || image.depth() == CV_32F || image.depth() == CV_64F;
    throw UserError(fmt::format("image {} has {} values, expected unsigned integers of 8 or 16 bits",
                                path.string(), real ? "floating-point" : "signed integer"));
  }
  return image;
}

// The largest value of the images that have 16 bits; 0 when none has.
int largest_of_16_bits(const StereoImages& images) {
  double largest = 0;
  for (const cv::Mat& image : {images.left, images.right}) {
    double value = 0;
    if (image.depth() == CV_16U) cv::minMaxLoc(image, nullptr, &value);
    largest = std::max(largest, value);
  }
  return static_cast<int>(largest);
}

bool has_16_bits(const StereoImages& images) {
  return images.left.depth() == CV_16U || images.right.depth() == CV_16U;
}

// Bits of cameras.
int bits_of(int largest) {
  int bits = 8;
  while (bits < 16 && largest >= 1 << bits) bits += 2;
  return bits;
}

}  // namespace

ImageInput::ImageInput(std::vector<ImagePair> pairs, const ImageChoice& choice, NoticeSink notice)
    : pairs_(std::move(pairs)), choice_(choice), notice_(std::move(notice)) {
  if (pairs_.empty()) {
    throw UserError("there is no image pair to read");
  }
  for (const ImagePair& pair : pairs_) {
    if (pair.in_memory()) continue;
    require_image_file(pair.left.string(), "image");
    require_image_file(pair.right.string(), "image");
  }
  note_same(load(0));
  if (choice_.bits && bits_ == 0) {
    throw UserError(fmt::format("--image-bits is for 16-bit images, but {} and its partner have 8 bits",
                                pairs_.front().left.string()));
  }
}

// But for pictures of one value, which say nothing.
void ImageInput::note_same(const StereoImages& images) const {
  double least = 0, most = 0;
  cv::minMaxLoc(images.left, &least, &most);
  if (!notice_ || least == most || cv::norm(images.left, images.right, cv::NORM_INF) != 0) return;
  notice_(fmt::format("the left image {} and the right image {} are the same picture",
                      pairs_.front().left.string(), pairs_.front().right.string()));
}

StereoImages ImageInput::load(std::size_t frame) {
  const ImagePair& pair = pairs_.at(frame);
  const StereoImages images = read_mono(pair);
  if (width_ == 0) {
    width_ = images.left.cols;
    height_ = images.left.rows;
  }
  if (images.left.cols != width_ || images.left.rows != height_) {
    throw UserError(
        fmt::format("image {} is {}, but the sequence began with {}x{}; all frames must have one size",
                    pair.left.string(), size_text(images.left.size()), width_, height_));
  }
  if (bits_ == 0 && has_16_bits(images)) choose_bits(frame, images);
  return {to_8_bit(images.left, pair.left), to_8_bit(images.right, pair.right)};
}

// A sequence that begins dark says little of what is to come. A frame that cannot be read is left for load(),
// when those before it are complete.
void ImageInput::choose_bits(std::size_t frame, const StereoImages& images) {
  if (choice_.bits) {
    bits_ = *choice_.bits;
    return;
  }
  constexpr int kSixteen = 16;
  int largest = largest_of_16_bits(images);
  const std::size_t end = choice_.first_only ? 0 : pairs_.size();
  for (std::size_t i = frame + 1; i < end && bits_of(largest) < kSixteen; ++i) {
    try {
      largest = std::max(largest, largest_of_16_bits(read_mono(pairs_[i])));
    } catch (const UserError&) {
      break;
    }
  }
  bits_ = choice_.first_only ? kSixteen : bits_of(largest);
  if (!notice_ || choice_.first_only) return;
  notice_(fmt::format(
      "16-bit images: their values reach {}, so they are taken as {}-bit {}; --image-bits states another",
      largest, bits_,
      bits_ == 8 ? "as they are" : fmt::format("and the lower {} bits are dropped", bits_ - 8)));
}

StereoImages ImageInput::read_mono(const ImagePair& pair) {
  const cv::Mat left = decode(pair.left, pair.pixels.left, choice_.limits);
  const cv::Mat right = decode(pair.right, pair.pixels.right, choice_.limits);
  if (left.size() != right.size()) {
    throw UserError(fmt::format("the left image {} is {}, the right image {} is {}; both must have one size",
                                pair.left.string(), size_text(left.size()), pair.right.string(),
                                size_text(right.size())));
  }
  return {to_mono(left, pair.left), to_mono(right, pair.right)};
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
      const int value = mono.at<std::uint16_t>(y, x) >> (bits_ - 8);
      if (value > 255) {
        throw UserError(fmt::format("image {} holds the value {}, beyond the {} bits{} (at most {})",
                                    path.string(), mono.at<std::uint16_t>(y, x), bits_,
                                    choice_.bits ? " of --image-bits" : " that the frames before it have",
                                    (1 << bits_) - 1));
      }
      result.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(value);
    }
  }
  return result;
}

}  // namespace parallax
