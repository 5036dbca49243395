// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/run_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <systemc>

#include "platform/commands/exchanged_sides.hpp"
#include "platform/input/raw_maps.hpp"
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
  if (folder_ == nullptr && !listener_) return;
  cv::Mat left(images_.padded(), CV_8UC1);
  std::copy(result.left.begin(), result.left.end(), left.begin<Gray>());
  frame.left = crop_image(left, images_.size());
  if (listener_) listener_(result.index, frame);
  if (folder_ != nullptr) write(result.index, frame);
}

// Costs some tenths of a second, which only a first frame with little to show is worth.
void RunFrames::look_at_sides(std::int64_t frame) {
  const StereoFrame images = images_.load(frame);
  const auto raw = [&](const SensorImage& pixels) {
    cv::Mat image(images_.padded(), CV_8UC1);
    std::copy(pixels->begin(), pixels->end(), image.begin<Gray>());
    return image;
  };
  const RawMaps maps = raw_maps(decode(images_.map()));
  const auto pair = [&](const cv::Mat& left, const cv::Mat& right) {
    StereoImages rectified;
    cv::remap(left, rectified.left, maps.left_x, maps.left_y, cv::INTER_LINEAR);
    cv::remap(right, rectified.right, maps.right_x, maps.right_y, cv::INTER_LINEAR);
    return StereoImages{crop_image(rectified.left, images_.size()),
                        crop_image(rectified.right, images_.size())};
  };
  const cv::Mat left = raw(images.left), right = raw(images.right);
  if (!sides_look_exchanged(pair(left, right), pair(right, left), largest_disparity_)) return;
  remarks_.push_back(
      "few pixels are valid, and left and right look exchanged: what the left image shows lies further right "
      "in "
      "the right image, where it must lie further left");
}

void RunFrames::write(std::int64_t index, const FrameImages& frame) {
  const bool single = images_.frames() == 1;
  write_frame(*folder_, single ? "" : fmt::format("frame_{:04}/", index), frame, options_);
  if (single) return;
  folder_->publish_written();
  if (!strip_)
    strip_ = std::make_unique<StripGif>(folder_->open("strip.gif"), images_.size(), options_.colors);
  strip_->add(frame.left, {frame.disparities, images_.size().width, images_.size().height},
              sc_core::sc_time_stamp().to_seconds() * 1e3);
}

}  // namespace parallax
