// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/run_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <systemc>
#include <utility>

#include "platform/commands/exchanged_sides.hpp"
#include "platform/results/truth_scale.hpp"

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
    if (!images_.is_scene()) {
      const std::string line = truth_scale_notice(frame.disparities, *frame.truth);
      if (!line.empty()) remarks_.push_back(line);
    }
  }
  if (totals_.frames == 1 && !images_.is_scene() && 2 * totals_.valid < totals_.pixels)
    look_at_sides(result.index);
  if (folder_ != nullptr) write(result, std::move(frame));
}

// Costs some hundredths of a second, which only a first frame with little to show is worth.
void RunFrames::look_at_sides(std::int64_t frame) {
  constexpr int kUnrectifiedRows = 16;  // px
  const StereoFrame images = images_.load(frame);
  const auto mat = [&](const SensorImage& pixels) {
    cv::Mat image(images_.padded(), CV_8UC1);
    std::copy(pixels->begin(), pixels->end(), image.begin<Gray>());
    return crop_image(image, images_.size());
  };
  if (!sides_look_exchanged(mat(images.left), mat(images.right), largest_disparity_,
                            images_.rectified() ? 0 : kUnrectifiedRows))
    return;
  remarks_.push_back(
      "few pixels are valid, and left and right look exchanged: what the left image shows lies further right "
      "in "
      "the right image, where it must lie further left");
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
