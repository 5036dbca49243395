// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

struct GifFileType;  // of giflib

namespace parallax {

/// An animated GIF, frame by frame, that plays for ever. Each call returns the next bytes of the file; none
/// of them is kept. Faults of giflib are std::runtime_error.
class GifEncoder {
 public:
  /// `palette`: at most 256 colours (BGR). `canvas`: px, at most 65535 each way.
  GifEncoder(const cv::Size& canvas, const std::vector<cv::Vec3b>& palette);
  GifEncoder(const GifEncoder&) = delete;
  GifEncoder& operator=(const GifEncoder&) = delete;

  /// `indices`: CV_8UC1, into the palette, at most as large as the canvas; from its top left corner on it
  /// takes the place of what is there. `centiseconds`: how long it is shown.
  std::string frame(const cv::Mat& indices, int centiseconds);

  /// The last bytes. No frame may follow.
  std::string end();

 private:
  void check(int result) const;

  std::string bytes_;  ///< of the file, since the last call
  struct Close {
    void operator()(GifFileType* gif) const;
  };
  std::unique_ptr<GifFileType, Close> gif_;
};

}  // namespace parallax
