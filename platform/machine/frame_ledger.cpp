// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/frame_ledger.hpp"

#include <algorithm>
#include <utility>

#include "platform/machine/steady_state.hpp"

namespace parallax {
namespace {

// Records that are kept beyond the warm-up, at the beginning and at the end of a run: more frames than can be
// under way, and than a queue usually takes to fill, as the steady state begins with one of them.
constexpr std::size_t kRecords = 1024;

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
      latencies_(steady_first(config, frames)),
      trend_(steady_first(config, frames), jitter_of(config),
             config.camera.jitter_ns == 0 ? LatencyTrend::kAlike : LatencyTrend::kByChance) {
  times_.keep(kept_);
  snapshots_.keep(kept_);
}

void FrameLedger::tell(std::int64_t frame, FrameStep step) const {
  if (listener_) listener_(frame, step);
}

void FrameLedger::exposed(const sc_core::sc_time& due, bool values) {
  values_.push_back(values);
  times_.push_back({});
  times_.back().exposed = sc_core::sc_time_stamp();
  times_.back().due = due;
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
  latencies_.add(frame, times);
  follow_trend(frame);
}

// Two frames after those that had a trend there is a frame rate again.
void FrameLedger::follow_trend(std::int64_t frame) {
  if (begins_anew_ && frame == *begins_anew_ + 1) {
    latencies_.begin_anew(*begins_anew_);
    for (std::int64_t since = *begins_anew_; since <= frame; ++since) latencies_.add(since, of(since));
    begins_anew_.reset();
  }
  const FrameTimes& times = of(frame);
  if (trend_.add(frame, times.at_host - times.due) && static_cast<std::size_t>(frame) + 2 < kept_)
    begins_anew_ = frame + 1;
}

}  // namespace parallax
