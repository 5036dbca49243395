// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/run_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <systemc>
#include <utility>

namespace parallax {

void RunFrames::take(const FrameResult& result) {
  FrameImages frame;
  frame.disparities = crop_disparities(result.disparities, images_.padded().width, images_.size());
  ++totals_.frames;
  totals_.pixels += images_.size().area();
  totals_.valid += std::count_if(frame.disparities.begin(), frame.disparities.end(),
                                 [](const Disparity& d) { return d.valid(); });
  frame.truth = images_.truth(result.index);
  if (frame.truth) {
    totals_.has_truth = true;
    totals_.score += score(frame.disparities, images_.size().width, *frame.truth);
  }
  if (folder_ != nullptr) write(result, std::move(frame));
}

void RunFrames::write(const FrameResult& result, FrameImages frame) {
  cv::Mat left(images_.padded(), CV_8UC1);
  std::copy(result.left.begin(), result.left.end(), left.begin<Gray>());
  frame.left = crop_image(left, images_.size());
  const bool single = images_.frames() == 1;
  write_frame(*folder_, single ? "" : fmt::format("frame_{:04}/", result.index), frame, options_);
  if (single) return;
  folder_->publish_written();
  if (!strip_)
    strip_ = std::make_unique<StripGif>(folder_->path() / "strip.gif", images_.size(), options_.colors);
  strip_->add(frame.left, {frame.disparities, images_.size().width, images_.size().height},
              sc_core::sc_time_stamp().to_seconds() * 1e3);
}

}  // namespace parallax
