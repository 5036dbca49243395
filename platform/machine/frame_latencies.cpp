// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/frame_latencies.hpp"

namespace parallax {

const std::vector<FrameSpan>& frame_spans() {
  static const std::vector<FrameSpan> spans{
      {"first_pixel",
       "from when the core can start with the frame, as much of it as it waits for being in memory, to its "
       "first disparity out of the last "
       "filter",
       &FrameTimes::startable, &FrameTimes::first_disparity},
      {"last_pixel",
       "from when the core can start with the frame, as much of it as it waits for being in memory, to its "
       "last disparity out of the last "
       "filter",
       &FrameTimes::startable, &FrameTimes::last_disparity},
      {"first_byte_to_first_pixel",
       "from the frame's first byte in memory to its first disparity out of the last filter",
       &FrameTimes::first_byte, &FrameTimes::first_disparity},
      {"first_byte_to_last_pixel",
       "from the frame's first byte in memory to its last disparity out of the last filter",
       &FrameTimes::first_byte, &FrameTimes::last_disparity},
      {"first_byte_to_host",
       "from the frame's first byte in memory to its last bit at the host, or, where the link is off, to its "
       "results in memory",
       &FrameTimes::first_byte, &FrameTimes::at_host},
      {"exposure_to_first_pixel",
       "from the end of exposure to the frame's first disparity out of the last filter", &FrameTimes::exposed,
       &FrameTimes::first_disparity},
      {"exposure_to_last_pixel",
       "from the end of exposure to the frame's last disparity out of the last filter", &FrameTimes::exposed,
       &FrameTimes::last_disparity},
      {"exposure_to_host",
       "from the end of exposure to the frame's last bit at the host, or, where the link is off, to its "
       "results in memory",
       &FrameTimes::exposed, &FrameTimes::at_host}};
  return spans;
}

void FrameLatencies::begin_anew(std::size_t frame, bool cycles) {
  steady_first_ = frame;
  steady_.assign(frame_spans().size(), {});
  open_.clear();
  if (cycles) open_.resize(frame_spans().size());
  whole_frames_ = open_frames_ = 0;
}

void FrameLatencies::begin_cycle(std::size_t frame) {
  for (std::size_t i = 0; i < steady_.size(); ++i) steady_[i] += open_[i];
  open_.assign(frame_spans().size(), {});
  whole_frames_ = frame - steady_first_;
  open_frames_ = 0;
}

void FrameLatencies::add(std::size_t frame, const FrameTimes& times) {
  if (frame == 0) first_frame_ = times;
  last_ = frame;
  if (frame < steady_first_) return;
  Histograms& histograms = open_.empty() ? steady_ : open_;
  if (!open_.empty()) ++open_frames_;
  for (std::size_t i = 0; i < histograms.size(); ++i) histograms[i].add(frame_spans()[i].of(times));
}

LatencyHistogram FrameLatencies::steady(std::size_t span) const {
  LatencyHistogram all = steady_[span];
  if (!open_.empty() && !whole_cycles()) all += open_[span];
  return all;
}

}  // namespace parallax
