// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/steady_state.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "platform/machine/machine.hpp"

namespace parallax {
namespace {

// After the warm-up: two frame periods lie between three arrivals at the host.
constexpr std::int64_t kMeasuredFrames = 3;
// With cameras that go their own way.
constexpr std::int64_t kManyFrames = 100;

}  // namespace

std::int64_t warm_up_frames(const MachineConfig& config) {
  return std::int64_t{config.camera.frame_buffers} + config.link.output_buffers;
}

std::size_t steady_first(const MachineConfig& config, std::int64_t frames) {
  return std::max<std::int64_t>(0, std::min(warm_up_frames(config), frames - 2));
}

std::int64_t frames_to_simulate(const MachineConfig& config, std::int64_t input_frames,
                                std::optional<std::int64_t> asked) {
  std::int64_t measured = kMeasuredFrames;
  if (config.camera.frame_rate > 0 || config.camera.fault != CameraFault::kNone) {
    // Buffers fill, or not; frames jitter, and some are lost: of these, whole rounds.
    const std::int64_t round = config.camera.fault == CameraFault::kNone
                                   ? 1
                                   : std::max<std::int64_t>(1, std::int64_t{config.camera.fault_every} - 1);
    measured = 1 + (kManyFrames + round - 1) / round * round;
  }
  return std::max(input_frames, asked.value_or(warm_up_frames(config) + measured));
}

SteadyWindow steady_window(const Machine& machine) {
  const KeptRecords<MachineSnapshot>& snapshots = machine.snapshots();
  SteadyWindow window;
  window.last = snapshots.size() - 1;
  if (window.last == 0) {
    window.text = "frame 1";
    return window;
  }
  window.first = steady_first(machine.config(), machine.input().frames);
  window.period =
      (snapshots[window.last].time - snapshots[window.first].time).to_seconds() / window.divisor();
  window.text = fmt::format("frames {} to {}", window.first + 2, window.last + 1);
  return window;
}

}  // namespace parallax
