// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <systemc>

#include "platform/machine/frame.hpp"

namespace parallax {

/// The cycles in which cameras with a rate of their own lose frames, when they send more than the machine
/// takes: each frame waits longer than the one before, until one finds no buffer free, after which the
/// next ones wait for less. Rates and latencies of such a machine are those of whole cycles.
class LossCycles {
 public:
  /// A frame is at the host, and the one before its exposure was lost.
  void begin(const FrameTimes& times) {
    latest_ = {times.at_host, times.at_host - times.due};
    if (number_++ == 0) first_ = latest_;
  }
  bool any() const { return number_ > 0; }
  /// Cycles that another one has followed.
  std::size_t whole() const { return number_ == 0 ? 0 : number_ - 1; }
  /// By which share the frame rate of many more cycles may differ from that of the whole ones, at most: they
  /// end with another latency than that with which they began. Needs a whole one.
  double uncertainty() const {
    return std::abs(latest_.latency.to_seconds() - first_.latency.to_seconds()) /
           (latest_.at_host - first_.at_host).to_seconds();
  }

 private:
  struct Beginning {
    sc_core::sc_time at_host;
    sc_core::sc_time latency;  // from the exposure
  };

  std::size_t number_ = 0;
  Beginning first_;
  Beginning latest_;
};

}  // namespace parallax
