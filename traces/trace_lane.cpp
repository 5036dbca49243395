// SPDX-License-Identifier: Apache-2.0
#include "traces/trace_lane.hpp"

#include <algorithm>

namespace parallax {

namespace {

// The next dates of lanes, the earliest of each group besides: not every lane is looked at for every date.
class NextDates {
 public:
  explicit NextDates(const std::vector<TraceLane*>& lanes)
      : lanes_(lanes), groups_((lanes.size() + kGroup - 1) / kGroup, TraceLane::kNever) {
    next_.reserve(lanes.size());
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
      next_.push_back(lanes[lane]->next());
      groups_[lane / kGroup] = std::min(groups_[lane / kGroup], next_.back());
    }
  }
  Picoseconds earliest() const {
    Picoseconds earliest = TraceLane::kNever;
    for (const Picoseconds group : groups_) earliest = std::min(earliest, group);
    return earliest;
  }
  void tell(Picoseconds date, const TraceSinks& sinks) {
    for (std::size_t group = 0; group < groups_.size(); ++group) {
      if (groups_[group] != date) continue;
      Picoseconds later = TraceLane::kNever;
      const std::size_t end = std::min(lanes_.size(), (group + 1) * kGroup);
      for (std::size_t lane = group * kGroup; lane < end; ++lane) {
        if (next_[lane] == date) next_[lane] = lanes_[lane]->tell(sinks);
        later = std::min(later, next_[lane]);
      }
      groups_[group] = later;
    }
  }

 private:
  static constexpr std::size_t kGroup = 12;

  const std::vector<TraceLane*>& lanes_;
  std::vector<Picoseconds> next_, groups_;
};

}  // namespace

void tell_until(Picoseconds date, const std::vector<TraceLane*>& lanes, const TraceSinks& sinks) {
  // A date has events in many lanes, as those of one clock share their dates: this costs less than lanes in
  // order.
  NextDates dates(lanes);
  for (Picoseconds now = dates.earliest(); now < date; now = dates.earliest()) dates.tell(now, sinks);
}

}  // namespace parallax
