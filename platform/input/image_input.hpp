// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "platform/input/image_pairs.hpp"
#include "platform/scene/stereo_images.hpp"

namespace parallax {

/// Largest image, px. The default is the device's (paper, section "Results", S).
struct ImageLimits {
  int width = 1856;
  int height = 1856;
};

/// Receives one line about something that is done to the images; each line once.
using NoticeSink = std::function<void(const std::string& line)>;

/// A sequence of stereo pairs from files. A frame is read when it is asked for and not kept, so memory does
/// not grow with the sequence. Every fault of the files is a UserError of one line.
///
/// Colour becomes mono by ITU-R BT.601 (0.299 R + 0.587 G + 0.114 B), transparency is ignored. 16-bit values
/// become 8-bit ones by dropping low bits: when no value of the first pair exceeds 4095, the sequence holds
/// 12-bit values and loses 4 bits, otherwise it loses 8. Both are said once.
class ImageInput {
 public:
  /// Looks whether all files exist, and reads the first pair for the size.
  ImageInput(std::vector<ImagePair> pairs, const ImageLimits& limits, NoticeSink notice);

  std::size_t frames() const { return pairs_.size(); }
  int width() const { return width_; }
  int height() const { return height_; }
  const ImagePair& paths(std::size_t frame) const { return pairs_.at(frame); }

  /// 8-bit mono, of one size through the sequence.
  StereoImages load(std::size_t frame);

 private:
  StereoImages read(const ImagePair& pair);
  cv::Mat to_mono(const cv::Mat& image, const std::filesystem::path& path);
  cv::Mat to_8_bit(const cv::Mat& mono, const std::filesystem::path& path) const;

  std::vector<ImagePair> pairs_;
  ImageLimits limits_;
  NoticeSink notice_;
  int width_ = 0;
  int height_ = 0;
  std::optional<int> dropped_bits_;  ///< of 16-bit input, by its first pair
  bool said_colour_ = false;
};

}  // namespace parallax
