// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "platform/machine/machine.hpp"
#include "platform/machine/steady_state.hpp"

namespace parallax {

/// How much of the time a part of the machine is at work.
struct PartLoad {
  const Part* part = nullptr;
  double share = 0;  ///< of the window, 0..1
  double busy = 0;   ///< s a frame: the frame period if nothing else took longer
};

/// Of every part of the machine (Machine::parts()), in their order. That of a DMA engine is the share of its
/// requests that are under way. Shares are taken between two dates of the part's own clock and never
/// exceed 1. The window must hold a frame.
std::vector<PartLoad> part_loads(const Machine& machine, const SteadyWindow& window);

/// What limits the frame rate.
struct Limit {
  bool limited = false;   ///< whether a part is at work (nearly) all the time
  PartLoad busiest;       ///< that part, else the one with the largest share
  PartLoad next;          ///< the busiest of those that do not run at its pace
  std::string otherwise;  ///< keys to look at when no part is the limit: what hands frames and tokens on
};

/// `loads` must not be empty; each has its part.
Limit find_limit(const std::vector<PartLoad>& loads);

}  // namespace parallax
