// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/frame_ledger.hpp"

#include <algorithm>
#include <utility>

#include "platform/machine/steady_state.hpp"

namespace parallax {
namespace {

// Records that are kept beyond the warm-up, at the beginning and at the end of a run: more frames than can be
// under way, and than a queue usually takes to fill, as the steady state begins with one of them.
constexpr std::size_t kRecords = kMostFrames;

// Of cycles of losses: by which share the frame rate may differ when it is not another when printed.
constexpr double kSameRate = 5e-5;

// By which the phases of two clocks and the memory's refreshes move a latency from frame to frame.
sc_core::sc_time jitter_of(const MachineConfig& config) {
  const ClockConfig& clocks = config.clocks;
  const std::int64_t slowest = std::min({clocks.core_hz, clocks.camera_hz, clocks.link_hz});
  const DramTiming& dram = config.memory.dram;
  const std::int64_t refreshes =
      config.memory.model == MemoryModel::kDram ? 2 * dram.rfc * dram.clock_period_ps : 0;
  return sc_core::sc_time(4.0 / static_cast<double>(slowest), sc_core::SC_SEC) +
         sc_core::sc_time(static_cast<double>(refreshes), sc_core::SC_PS);
}

}  // namespace

FrameLedger::FrameLedger(const MachineConfig& config, std::int64_t frames, StepListener listener)
    : kept_(warm_up_frames(config) + kRecords),
      listener_(std::move(listener)),
      by_chance_(config.camera.jitter_ns != 0),
      latencies_(steady_first(config, frames), kRecords),
      trend_(steady_first(config, frames), jitter_of(config),
             by_chance_ ? LatencyTrend::kByChance : LatencyTrend::kAlike) {
  times_.keep(kept_);
  snapshots_.keep(kept_);
}

void FrameLedger::tell(std::int64_t frame, FrameStep step) const {
  if (listener_) listener_(frame, step);
}

void FrameLedger::exposed(const sc_core::sc_time& due, std::int64_t lost, bool values) {
  values_.push_back(values);
  times_.push_back({});
  times_.back().exposed = sc_core::sc_time_stamp();
  times_.back().due = due;
  times_.back().lost = lost;
  tell(times_.size() - 1, FrameStep::kExposed);
}

void FrameLedger::first_byte(std::int64_t frame) {
  sc_core::sc_time& date = of(frame).first_byte;
  if (date != sc_core::SC_ZERO_TIME) return;
  date = sc_core::sc_time_stamp();
  tell(frame, FrameStep::kFirstByte);
}

void FrameLedger::startable(std::int64_t frame) {
  of(frame).startable = sc_core::sc_time_stamp();
  tell(frame, FrameStep::kStartable);
}

void FrameLedger::in_memory(std::int64_t frame) {
  of(frame).in_memory = sc_core::sc_time_stamp();
  tell(frame, FrameStep::kInMemory);
}

void FrameLedger::core_started(std::int64_t frame) {
  of(frame).core_started = sc_core::sc_time_stamp();
  tell(frame, FrameStep::kCoreStarted);
}

void FrameLedger::results_in_memory(std::int64_t frame, const sc_core::sc_time& first_disparity,
                                    const sc_core::sc_time& last_disparity) {
  FrameTimes& times = of(frame);
  times.results_in_memory = sc_core::sc_time_stamp();
  times.first_disparity = first_disparity;
  times.last_disparity = last_disparity;
  tell(frame, FrameStep::kResultsInMemory);
}

void FrameLedger::at_host(std::int64_t frame) {
  FrameTimes& times = of(frame);
  times.at_host = sc_core::sc_time_stamp();
  tell(frame, FrameStep::kAtHost);
  // With the arrival of two frames there is a frame rate again.
  if (begins_anew_ && frame == *begins_anew_ + 1) begin_anew();
  const bool losing = follow_losses(frame);
  latencies_.add(frame, times);
  if (!losing && trend_.add(frame, times.at_host - times.due)) begins_anew_ = frame + 1;
}

void FrameLedger::begin_anew() {
  const std::int64_t first = *begins_anew_;
  begins_anew_.reset();
  times_.pin(first);
  snapshots_.pin(first);
  latencies_.begin_anew(first, losses_.any());
  latencies_.add(first, of(first));
}

// Whether the steady state is one of losses.
bool FrameLedger::follow_losses(std::int64_t frame) {
  if (by_chance_ || frame == 0 || static_cast<std::size_t>(frame) < latencies_.steady_first()) return false;
  if (of(frame).lost == of(frame - 1).lost) return losses_.any();
  if (losses_.any()) {
    latencies_.begin_cycle(frame);
  } else {
    begins_anew_ = frame;
  }
  losses_.begin(of(frame));
  return true;
}

bool FrameLedger::settled() const {
  if (losses_.any()) {
    return losses_.whole() > 1 && latencies_.steady_end() + 1 == snapshots_.size() &&
           losses_.uncertainty() <= kSameRate;
  }
  return trend_.settled() && snapshots_.back().cameras.lost() == times_[latencies_.steady_first()].lost;
}

}  // namespace parallax
