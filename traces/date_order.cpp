// SPDX-License-Identifier: Apache-2.0
#include "traces/date_order.hpp"

#include <algorithm>

namespace parallax {

template <class Event>
Picoseconds DateOrder::EventLane<Event>::tell(TraceSink& sink) {
  const Picoseconds date = events_.date();
  do {
    DateOrder::tell(sink, events_.front());
    events_.pop();
  } while (!events_.empty() && events_.date() == date);
  return next();
}

template <class Event>
DateOrder::EventLane<Event>* DateOrder::add_lane() {
  auto lane = std::make_unique<EventLane<Event>>();
  EventLane<Event>* const added = lane.get();
  lanes_.push_back(std::move(lane));
  return added;
}

void DateOrder::begin(const TraceParts& parts) {
  steps_ = add_lane<Step>();
  frames_ = add_lane<FrameRecord>();
  for (std::size_t i = 0; i < parts.streams.size(); ++i) {
    fifos_.push_back(add_lane<FifoSpan>());
    if (parts.tokens) tokens_.push_back(add_lane<TokenTransfer>());
  }
  for (std::size_t i = 0; i < parts.stages.size(); ++i) {
    rows_.push_back(add_lane<StageRow>());  // a row ends before the next one begins
    row_begins_.push_back(add_lane<RowBegin>());
    if (parts.tokens) firings_.push_back(add_lane<StageFiring>());
  }
  for (std::size_t i = 0; i < parts.ports.size(); ++i) {
    port_rows_.push_back(add_lane<PortRow>());
    if (!parts.tokens) continue;
    requests_.push_back(add_lane<PortRequests>());
    bursts_.push_back(add_lane<BurstTransfer>());
  }
  sink_->begin(parts);
}

void DateOrder::known_until(Picoseconds date) {
  // The next dates of the lanes that have any to tell, and besides them the earliest of each group: not every
  // lane is looked at for every date. A date has events in many lanes, as those of one clock share their
  // dates: this costs less than lanes in order.
  constexpr std::size_t kGroup = 12;
  std::vector<Picoseconds> next;
  std::vector<Lane*> lanes;
  next.reserve(lanes_.size());
  lanes.reserve(lanes_.size());
  for (const std::unique_ptr<Lane>& lane : lanes_) {
    const Picoseconds first = lane->next();
    if (first >= date) continue;
    next.push_back(first);
    lanes.push_back(lane.get());
  }
  std::vector<Picoseconds> groups((lanes.size() + kGroup - 1) / kGroup, kNever);
  for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
    groups[lane / kGroup] = std::min(groups[lane / kGroup], next[lane]);
  }
  for (;;) {
    Picoseconds now = kNever;
    for (const Picoseconds group : groups) now = std::min(now, group);
    if (now >= date) break;
    for (std::size_t group = 0; group < groups.size(); ++group) {
      if (groups[group] != now) continue;
      Picoseconds later = kNever;
      const std::size_t end = std::min(lanes.size(), (group + 1) * kGroup);
      for (std::size_t lane = group * kGroup; lane < end; ++lane) {
        if (next[lane] == now) next[lane] = lanes[lane]->tell(*sink_);
        later = std::min(later, next[lane]);
      }
      groups[group] = later;
    }
  }
  sink_->known_until(date);
}

void DateOrder::end(Picoseconds time, const std::vector<EndlessWait>& waits) {
  known_until(kNever);
  sink_->end(time, waits);
}

}  // namespace parallax
