// SPDX-License-Identifier: Apache-2.0
#include "traces/trace_lane.hpp"

#include <algorithm>
#include <functional>

namespace parallax {

void tell_until(Picoseconds date, const std::vector<TraceLane*>& lanes, const TraceSinks& sinks) {
  using Next = std::pair<std::int64_t, std::size_t>;  // date, lane
  std::vector<Next> heap;
  for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
    if (const Picoseconds next = lanes[lane]->next(); next < date) heap.emplace_back(next.count(), lane);
  }
  std::make_heap(heap.begin(), heap.end(), std::greater<>());
  while (!heap.empty()) {
    std::pop_heap(heap.begin(), heap.end(), std::greater<>());
    TraceLane& lane = *lanes[heap.back().second];
    const Next next_of_others = heap.size() > 1 ? heap.front() : Next{date.count(), 0};
    Next& own = heap.back();
    do {
      lane.tell(sinks);
      own.first = lane.next().count();
    } while (own < next_of_others && own.first < date.count());
    if (own.first < date.count()) {
      std::push_heap(heap.begin(), heap.end(), std::greater<>());
    } else {
      heap.pop_back();
    }
  }
}

}  // namespace parallax
