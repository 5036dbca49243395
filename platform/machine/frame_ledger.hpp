// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <systemc>
#include <vector>

#include "platform/config/machine_config.hpp"
#include "platform/machine/frame.hpp"
#include "platform/machine/frame_latencies.hpp"
#include "platform/machine/latency_trend.hpp"
#include "platform/machine/loss_cycles.hpp"
#include "platform/machine/machine_snapshot.hpp"
#include "tlm/kept_records.hpp"
#include "traces/trace_event.hpp"

namespace parallax {

/// What is known of the frames of a run: the dates at which each came to the parts of the machine, how long
/// that took, whether it carries images. The parts write it; whoever follows frames is told of each step.
/// Of long runs the first and the last frames are kept only, at least 1024 beyond the warm-up.
class FrameLedger {
 public:
  using StepListener = std::function<void(std::int64_t frame, FrameStep step)>;

  /// Of a run of `frames`. `listener` may be empty.
  FrameLedger(const MachineConfig& config, std::int64_t frames, StepListener listener);

  /// The next frame is exposed, now, and would be at `due` without jitter. `lost`: triggers before it that
  /// found no buffer or a sensor reading out. `values`: it carries images.
  void exposed(const sc_core::sc_time& due, std::int64_t lost, bool values);
  /// The first byte of one of its images is in memory, now; of two calls the first counts.
  void first_byte(std::int64_t frame);
  /// As much of it is in memory, now, as the core waits for.
  void startable(std::int64_t frame);
  void in_memory(std::int64_t frame);
  /// The core has been started with it, now.
  void core_started(std::int64_t frame);
  /// The core has read the images of the next frame, now.
  void images_read() { of(read_++).read = sc_core::sc_time_stamp(); }
  /// Its results are in memory, now; its first and its last disparity left the last filter at these dates.
  void results_in_memory(std::int64_t frame, const sc_core::sc_time& first_disparity,
                         const sc_core::sc_time& last_disparity);
  /// The host has it, now; to be followed by the snapshot of that date.
  void at_host(std::int64_t frame);
  void add(const MachineSnapshot& snapshot) { snapshots_.push_back(snapshot); }

  bool has_values(std::int64_t frame) const { return values_[frame]; }
  /// Of all frames that were exposed; the last ones may be unfinished.
  const KeptRecords<FrameTimes>& times() const { return times_; }
  /// One for each frame at the host, of that date.
  const KeptRecords<MachineSnapshot>& snapshots() const { return snapshots_; }
  /// Of all frames at the host.
  const FrameLatencies& latencies() const { return latencies_; }
  /// Likewise, from exposure to the host, of exposures without their jitter: the queue's part of it.
  /// Nothing is added to it after the first frame of the steady state that the cameras lost.
  const LatencyTrend& trend() const { return trend_; }
  /// In the steady state; none of cameras whose triggers jitter, which lose frames by chance.
  const LossCycles& losses() const { return losses_; }
  /// Whether the frames at the host show no trend, and no losses, or cycles of them that repeat.
  bool settled() const;
  /// The number of records that are kept of the beginning of a run, and of its end.
  std::size_t kept() const { return kept_; }

 private:
  FrameTimes& of(std::int64_t frame) { return times_[frame]; }
  void begin_anew();
  bool follow_losses(std::int64_t frame);
  void tell(std::int64_t frame, FrameStep step) const;

  const std::size_t kept_;
  const StepListener listener_;
  const bool by_chance_;  // triggers jitter
  KeptRecords<FrameTimes> times_;
  KeptRecords<MachineSnapshot> snapshots_;
  FrameLatencies latencies_;
  LatencyTrend trend_;
  LossCycles losses_;
  std::optional<std::int64_t> begins_anew_;  // frame with which the steady state begins once more
  std::int64_t read_ = 0;                    // frames whose images the core has read
  std::vector<bool> values_;
};

}  // namespace parallax
