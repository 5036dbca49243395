// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>

namespace parallax {

/// When results leave a circuit without valid at its outputs: `latency` edges behind the edge that took the
/// token, whether the edges between took one or not.
class ResultDelay {
 public:
  /// `of_pass`: tokens and zeros that a pass over the image, or a tile, sends in, >= 1 when edge() takes one.
  void configure(std::uint64_t latency, std::uint64_t of_pass) {
    latency_ = latency;
    of_pass_ = of_pass;
  }
  /// Before the next edge: whether a result is there; `takes`: whether that edge will take a token, of which
  /// the result is there at once without latency.
  bool there(bool takes) const { return latency_ == 0 ? takes : !due_.empty() && due_.front() == edges_; }
  /// Of the result that is there, or comes next: its number in the pass.
  std::uint64_t number() const { return number_; }
  /// Whether that is pushed out by the pass itself, and not by the next one's tokens.
  bool within_pass() const { return number_ + latency_ < of_pass_; }

  void edge(bool takes) {
    const bool leaves = there(takes);
    if (takes && latency_ > 0) due_.push_back(edges_ + latency_);
    if (leaves && latency_ > 0) due_.pop_front();
    if (leaves && ++number_ == of_pass_) number_ = 0;
    ++edges_;
  }

 private:
  std::uint64_t latency_ = 0;
  std::uint64_t of_pass_ = 0;
  std::uint64_t edges_ = 0;
  std::uint64_t number_ = 0;
  std::deque<std::uint64_t> due_;  // edges before which a result is there
};

}  // namespace parallax
