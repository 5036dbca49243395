// SPDX-License-Identifier: Apache-2.0
#include "traces/trace_lane.hpp"

#include <algorithm>

namespace parallax {

void tell_until(Picoseconds date, const std::vector<TraceLane*>& lanes, const TraceSinks& sinks) {
  // A date has events in many lanes, as those of one clock share their dates: going through the lanes for
  // each date costs less than keeping them sorted.
  std::vector<Picoseconds> next;
  next.reserve(lanes.size());
  Picoseconds now = TraceLane::kNever;
  for (const TraceLane* lane : lanes) {
    next.push_back(lane->next());
    now = std::min(now, next.back());
  }
  while (now < date) {
    Picoseconds later = TraceLane::kNever;
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
      if (next[lane] == now) {
        lanes[lane]->tell(sinks);
        next[lane] = lanes[lane]->next();
      }
      later = std::min(later, next[lane]);
    }
    now = later;
  }
}

}  // namespace parallax
