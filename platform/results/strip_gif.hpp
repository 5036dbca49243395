// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "platform/results/color_scale.hpp"
#include "platform/results/disparity_view.hpp"
#include "platform/results/gif_encoder.hpp"
#include "platform/results/output_file.hpp"

namespace parallax {

/// strip.gif: the frames of a sequence as an animation that plays for ever, the left image beside the
/// disparities, with a legend below; 640 px wide and high at most, apart
/// from the legend. All frames have the same colours. A frame is shown
/// until the next one arrived, yet for 20 ms at least: browsers slow down what is faster. Memory for one
/// frame.
class StripGif {
 public:
  /// `file` outlives this object. `frame`: size of a frame, px.
  StripGif(OutputFile& file, const cv::Size& frame, const ColorScale& scale);

  /// `left`: CV_8UC1. `milliseconds`: when the frame arrived, in the sequence's time; not before the one
  /// before. Throws UserError when the disk is full.
  void add(const cv::Mat& left, const DisparityView& disparities, double milliseconds);

  /// No frame follows: brings all data to the file system. Throws UserError when the disk is full.
  void complete();

 private:
  void write(double milliseconds);

  cv::Size panel_;
  ColorScale scale_;
  std::vector<cv::Vec3b> palette_;
  cv::Mat legend_;  ///< palette indices
  OutputFile& file_;
  GifEncoder encoder_;
  cv::Mat waiting_;  ///< palette indices of the last frame: how long it is shown the next one says
  double since_ = 0;
  double shown_ = 0;
};

}  // namespace parallax
