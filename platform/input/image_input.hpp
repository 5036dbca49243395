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

/// How the images of a sequence are taken.
struct ImageChoice {
  ImageLimits limits;
  std::optional<int>
      bits;  ///< 8..16, of the values in 16-bit images; none: as many as the largest value asks for
  bool first_only = false;  ///< only the size is wanted: nothing but the first pair is looked at
};

/// A sequence of stereo pairs from files, or in memory. A frame is read when it is asked for and not kept, so
/// memory does not grow with the sequence. Every fault of the files is a UserError of one line.
///
/// Colour becomes mono by ITU-R BT.601 (0.299 R + 0.587 G + 0.114 B), transparency is ignored. 16-bit values
/// become 8-bit ones by dropping low bits. How many bits they have is stated, or else it is the least of 8,
/// 10, 12, 14 and 16 that holds the largest value of the whole sequence, which is looked at before the first
/// frame; that is said once.
class ImageInput {
 public:
  /// Looks whether all files exist, and reads the first pair for the size; where it has 16 bits, all.
  ImageInput(std::vector<ImagePair> pairs, const ImageChoice& choice, NoticeSink notice);

  std::size_t frames() const { return pairs_.size(); }
  int width() const { return width_; }
  int height() const { return height_; }
  const ImagePair& paths(std::size_t frame) const { return pairs_.at(frame); }

  /// 8-bit mono, of one size through the sequence.
  StereoImages load(std::size_t frame);

 private:
  StereoImages read_mono(const ImagePair& pair);
  void note_same(const StereoImages& images) const;
  void choose_bits(std::size_t frame, const StereoImages& images);
  cv::Mat to_mono(const cv::Mat& image, const std::filesystem::path& path);
  cv::Mat to_8_bit(const cv::Mat& mono, const std::filesystem::path& path) const;

  std::vector<ImagePair> pairs_;
  ImageChoice choice_;
  NoticeSink notice_;
  int width_ = 0;
  int height_ = 0;
  int bits_ = 0;  ///< of 16-bit images; 0: there was none
  bool said_colour_ = false;
};

}  // namespace parallax
