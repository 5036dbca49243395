// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <nlohmann/json.hpp>

#include "platform/machine/machine.hpp"
#include "traces/date_order.hpp"
#include "traces/frame_profile.hpp"
#include "traces/recorder.hpp"

namespace parallax {

/// What a report shows over the time of a frame, and how latencies are distributed: profile.json.
class RunProfile {
 public:
  /// To be made when the machine is, before the simulation starts.
  RunProfile(const Machine& machine, SamplingTimer& timer);

  /// Now; frames after the run's last one are left out.
  void frame_step(std::int64_t frame, FrameStep step) {
    if (frame < machine_.input().frames) recorder_.frame_step(frame, step);
  }
  /// When the simulation is over.
  void finish() { recorder_.finish(); }
  /// {"frame": FrameProfile, "latency": {span or port: {"unit": "ps", "at_most": [...], "count": [...]}}}:
  /// how many frames of the steady state, or bursts of the run, took at most so long, and more than the entry
  /// before.
  nlohmann::ordered_json to_json() const;

 private:
  const Machine& machine_;
  const std::shared_ptr<FrameProfile> frame_;
  DateOrder order_;
  Recorder recorder_;
};

}  // namespace parallax
