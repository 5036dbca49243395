// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
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

/// How long these took: the first frame, and the distribution over all frames from a given one on, or over
/// whole cycles of them.
class FrameLatencies {
 public:
  /// `steady_first`: number of the first frame whose latencies are those of the steady state. `most_open`:
  /// frames of an unfinished cycle, of which more belong to the steady state.
  FrameLatencies(std::size_t steady_first, std::size_t most_open)
      : steady_first_(steady_first), most_open_(most_open), steady_(frame_spans().size()) {}

  /// The steady state begins with this frame, later than was thought. `cycles`: it consists of cycles, of
  /// which this frame begins one.
  void begin_anew(std::size_t frame, bool cycles);
  /// This frame begins another cycle; to be called before it is added.
  void begin_cycle(std::size_t frame);
  /// Frame `frame` is at the host; in order.
  void add(std::size_t frame, const FrameTimes& times);

  /// Number of the first frame of the steady state.
  std::size_t steady_first() const { return steady_first_; }
  /// Whether the steady state is whole cycles: not where the unfinished one is longer than these.
  bool whole_cycles() const {
    return whole_frames_ >= std::max<std::size_t>(1, open_frames_) && open_frames_ <= most_open_;
  }
  /// Number of the frame with whose arrival the steady state ends: the last one, or that which begins the
  /// unfinished cycle.
  std::size_t steady_end() const { return whole_cycles() ? steady_first_ + whole_frames_ : last_; }
  /// Numbers of the frames, of which the last one is left out, whose latencies are those of the steady state.
  std::size_t measured_end() const { return whole_cycles() ? steady_end() : last_ + 1; }
  const FrameTimes& first_frame() const { return first_frame_; }
  /// By the index of the span.
  LatencyHistogram steady(std::size_t span) const;

 private:
  using Histograms = std::vector<LatencyHistogram>;  // by the index of the span

  std::size_t steady_first_;
  const std::size_t most_open_;
  std::size_t last_ = 0;
  FrameTimes first_frame_;
  Histograms steady_;
  Histograms open_;  // likewise, of the unfinished cycle; empty where there are none
  std::size_t whole_frames_ = 0;
  std::size_t open_frames_ = 0;
};

}  // namespace parallax
