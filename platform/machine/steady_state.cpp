// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/steady_state.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "platform/machine/machine.hpp"

namespace parallax {
namespace {

// After the warm-up: two frame periods lie between three arrivals at the host.
constexpr std::int64_t kMeasuredFrames = 3;
// Where no frame is like the one before.
constexpr std::int64_t kManyFrames = 100;

// By which share of a window its ends may move and no rate is another when it is printed.
constexpr double kUnseen = 5e-5;

// Whether jitter moves the window's ends, and all that the cameras send comes through, at their pace.
bool paced_with_jitter(const Machine& machine, const SteadyWindow& window) {
  if (machine.config().camera.jitter_ns * 1e-9 <= kUnseen * window.seconds || !machine.trend().settled())
    return false;
  const CameraCounts& first = machine.snapshots()[window.first].cameras;
  const CameraCounts& last = machine.snapshots()[window.last].cameras;
  return last.dropped == first.dropped && last.missed == first.missed;
}

}  // namespace

std::int64_t warm_up_frames(const MachineConfig& config) {
  // A frame waits in full frame buffers for one that waits in full output buffers.
  return std::int64_t{config.camera.frame_buffers} + config.link.output_buffers + 2;
}

std::size_t steady_first(const MachineConfig& config, std::int64_t frames) {
  return std::max<std::int64_t>(0, std::min(warm_up_frames(config), frames - 2));
}

RunLength run_length(const MachineConfig& config, std::int64_t input_frames,
                     std::optional<std::int64_t> asked) {
  const auto at_least_input = [&](std::int64_t frames) { return std::max(input_frames, frames); };
  if (asked) return {at_least_input(*asked), at_least_input(*asked)};
  const std::int64_t warm_up = warm_up_frames(config);
  const std::int64_t few = at_least_input(warm_up + kMeasuredFrames);
  if (config.camera.jitter_ns == 0 && config.camera.fault == CameraFault::kNone)
    return {few, at_least_input(warm_up + kMostFrames)};
  // Of faulty frames, whole rounds.
  const std::int64_t round = config.camera.fault == CameraFault::kNone
                                 ? 1
                                 : std::max<std::int64_t>(1, std::int64_t{config.camera.fault_every} - 1);
  const std::int64_t many = at_least_input(warm_up + 1 + (kManyFrames + round - 1) / round * round);
  return {many, many};
}

SteadyWindow steady_window(const Machine& machine) {
  const KeptRecords<MachineSnapshot>& snapshots = machine.snapshots();
  SteadyWindow window;
  if (snapshots.size() == 1) {
    window.text = "frame 1";
    return window;
  }
  window.first = machine.latencies().steady_first();
  window.last = machine.latencies().steady_end();
  window.seconds = (snapshots[window.last].time - snapshots[window.first].time).to_seconds();
  if (paced_with_jitter(machine, window))
    window.seconds = (machine.times()[window.last].due - machine.times()[window.first].due).to_seconds();
  window.text = fmt::format("frames {} to {}", window.first + 2, window.last + 1);
  return window;
}

}  // namespace parallax
