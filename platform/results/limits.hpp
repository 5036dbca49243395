// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "platform/machine/machine.hpp"

namespace parallax {

/// The frames between whose arrivals at the host the steady state is measured.
struct SteadyWindow {
  std::size_t first = 0;  ///< index of the frame whose arrival begins it
  std::size_t last = 0;   ///< index of the frame whose arrival ends it
  double period = 0;      ///< s a frame; 0 when there is one frame only
  std::string text;       ///< for reports

  std::size_t frames() const { return last - first; }
};

/// Frames that a run simulates: all of the input, and at least `asked`; if nothing is asked, so many that two
/// frame periods lie after the warm-up, or a hundred and more where cameras have a rate of their own or
/// faults.
std::int64_t frames_to_simulate(const MachineConfig& config, std::int64_t input_frames,
                                std::optional<std::int64_t> asked);

/// All frames of a run after the warm-up; where the run is shorter than that, its last two.
SteadyWindow steady_window(const Machine& machine);

/// How much of the time a part of the machine is at work.
struct PartLoad {
  std::string part;
  std::string key;          ///< the configuration key that makes it faster
  double share = 0;         ///< of the window, 0..1
  double busy = 0;          ///< s a frame: the frame period if nothing else took longer
  bool core_waits = false;  ///< the core may wait for it while it counts as at work
  bool is_pace = false;     ///< a pace that is given, not work
};

/// Every part that can be the limit, in the order in which data meets them: memory, cameras, DMA engines (the
/// share of their requests that are under way), core (with a frame, or about to be started with one; unless
/// frames queue), stages, link, host. Shares are taken between two dates of the
/// part's own clock and never exceed 1. The window must hold a frame.
std::vector<PartLoad> part_loads(const Machine& machine, const SteadyWindow& window);

/// What limits the frame rate.
struct LimitVerdict {
  bool limited = false;   ///< whether a part is at work (nearly) all the time
  PartLoad busiest;       ///< that part, else the one with the largest share
  PartLoad next;          ///< the busiest of those that do not run at its pace
  std::string otherwise;  ///< keys to look at when no part is the limit: what hands frames and tokens on
};

LimitVerdict find_limit(const std::vector<PartLoad>& loads);

}  // namespace parallax
