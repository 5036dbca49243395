// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "platform/config/machine_config.hpp"

namespace parallax {

class Machine;

/// Frames until all buffers have been filled and handed on once; before that the rate is that of buffers
/// filling.
std::int64_t warm_up_frames(const MachineConfig& config);

/// Number of the first frame of the steady state in a run of `frames`; where that is shorter than the
/// warm-up, of its last but one.
std::size_t steady_first(const MachineConfig& config, std::int64_t frames);

/// Frames that a run simulates: all of the input, and at least `asked`; if nothing is asked, so many that two
/// frame periods lie after the warm-up, or a hundred and more where cameras have a rate of their own or
/// faults.
std::int64_t frames_to_simulate(const MachineConfig& config, std::int64_t input_frames,
                                std::optional<std::int64_t> asked);

/// The frames between whose arrivals at the host the steady state is measured.
struct SteadyWindow {
  std::size_t first = 0;  ///< index of the frame whose arrival begins it
  std::size_t last = 0;   ///< index of the frame whose arrival ends it
  double period = 0;      ///< s a frame; 0 when there is one frame only
  std::string text;       ///< for reports

  std::size_t frames() const { return last - first; }
  /// The number of frames to divide what is counted in the window by: a run's only frame has no window.
  double divisor() const { return frames() == 0 ? 1.0 : static_cast<double>(frames()); }
};

/// All frames of a run after the warm-up; where the run is shorter than that, its last two. The host must
/// have a frame.
SteadyWindow steady_window(const Machine& machine);

}  // namespace parallax
