// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <systemc>
#include <vector>

#include "platform/machine/frame.hpp"
#include "tlm/latency_histogram.hpp"

namespace parallax {

/// A way that every frame goes, from one of its dates to a later one.
struct FrameSpan {
  const char* name;         ///< "first_pixel"
  const char* description;  ///< "from the ... to its ..."
  sc_core::sc_time FrameTimes::*from;
  sc_core::sc_time FrameTimes::*to;

  sc_core::sc_time of(const FrameTimes& times) const { return times.*to - times.*from; }
};

/// From the exposure's end, from the first byte in memory and from the whole frame in memory, to the first
/// and the last disparity and to the last byte on the wire.
const std::vector<FrameSpan>& frame_spans();

/// How long these took: the first frame, and the distribution over all frames from a given one on.
class FrameLatencies {
 public:
  /// `steady_first`: number of the first frame whose latencies are those of the steady state.
  explicit FrameLatencies(std::size_t steady_first)
      : steady_first_(steady_first), steady_(frame_spans().size()) {}

  /// The steady state begins with this frame, later than was thought.
  void begin_anew(std::size_t frame) {
    steady_first_ = frame;
    std::fill(steady_.begin(), steady_.end(), LatencyHistogram());
  }
  /// Number of the first frame of the steady state.
  std::size_t steady_first() const { return steady_first_; }
  /// Frame `frame` is at the host; in order.
  void add(std::size_t frame, const FrameTimes& times) {
    if (frame == 0) first_ = times;
    if (frame < steady_first_) return;
    for (std::size_t i = 0; i < steady_.size(); ++i) steady_[i].add(frame_spans()[i].of(times));
  }
  const FrameTimes& first_frame() const { return first_; }
  /// By the index of the span.
  const LatencyHistogram& steady(std::size_t span) const { return steady_[span]; }

 private:
  std::size_t steady_first_;
  FrameTimes first_;
  std::vector<LatencyHistogram> steady_;
};

}  // namespace parallax
