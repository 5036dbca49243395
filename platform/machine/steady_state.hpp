// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "platform/config/machine_config.hpp"

namespace parallax {

class Machine;

/// Frames until all buffers have been filled and handed on once, and the first that found them so are
/// through; before that the rate and the latency are those of buffers filling.
std::int64_t warm_up_frames(const MachineConfig& config);

/// Number of the first frame of the steady state in a run of `frames`; where that is shorter than the
/// warm-up, of its last but one.
std::size_t steady_first(const MachineConfig& config, std::int64_t frames);

/// After so many frames beyond the warm-up a run ends, steady or not, unless it was asked for more.
constexpr std::int64_t kMostFrames = 1024;

/// How many frames a run simulates.
struct RunLength {
  std::int64_t least = 1;
  std::int64_t most = 1;  ///< when the steady state has not come before
};

/// All frames of the input, and at least `asked`; if nothing is asked, so many that two frame periods lie
/// after the warm-up, and on until more frames would show nothing new (MachineInput::enough),
/// within kMostFrames. Where triggers jitter or frames have faults, a hundred and more.
RunLength run_length(const MachineConfig& config, std::int64_t input_frames,
                     std::optional<std::int64_t> asked);

/// The frames between whose arrivals at the host the steady state is measured.
struct SteadyWindow {
  std::size_t first = 0;  ///< index of the frame whose arrival begins it
  std::size_t last = 0;   ///< index of the frame whose arrival ends it
  double seconds = 0;     ///< that its frames take; 0 when there is one frame only
  std::string text;       ///< for reports

  std::size_t frames() const { return last - first; }
  /// s a frame.
  double period() const { return seconds / divisor(); }
  /// The number of frames to divide what is counted in the window by: a run's only frame has no window.
  double divisor() const { return frames() == 0 ? 1.0 : static_cast<double>(frames()); }
};

/// All frames of a run after the warm-up, and after those whose latency had a trend (LatencyTrend); of
/// cameras that lose frames, whole cycles of that (LossCycles). Where the run is shorter than the warm-up,
/// its last two. The host must have a frame.
///
/// Its frames take the time between the arrivals that begin and end it. Cameras whose triggers jitter move
/// both: where every frame of theirs comes through and none waits longer than the one before, the frames take
/// what their exposures would without the jitter.
SteadyWindow steady_window(const Machine& machine);

}  // namespace parallax
