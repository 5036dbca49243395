// SPDX-License-Identifier: Apache-2.0
#include "tlm/bus_scheduler.hpp"

#include <algorithm>
#include <numeric>

namespace parallax {

void BusScheduler::bind(MemoryQueues& queues) {
  queues_ = &queues;
  taken_.resize(queues.ports());
  if (queues.ports() > 0) last_served_ = queues.ports() - 1;  // the first turn is the first port's
}

double BusScheduler::usable_bandwidth() const {
  return timing_.bytes_per_cycle.real() * static_cast<double>(timing_.efficiency) / 100.0 *
         clock_.frequency().real();
}

Cycles BusScheduler::transfer_time(const ::tlm::tlm_generic_payload& payload) {
  const std::int64_t bytes = payload.get_data_length();
  if (bytes == 0) return Cycles(1);  // not allowed, but even this is over some time after its arrival
  const std::int64_t per_cycle = timing_.bytes_per_cycle.count() * timing_.efficiency;
  if (bytes != last_length_) last_transfer_ = Cycles((bytes * 100 + per_cycle - 1) / per_cycle);
  last_length_ = bytes;
  return last_transfer_;
}

Picoseconds BusScheduler::first_arrival() const {
  return *std::min_element(queues_->arrivals().begin(), queues_->arrivals().end());
}

// When the bus is free and a request is there; needs one that waits.
Cycles BusScheduler::next_edge() const {
  const Picoseconds first = first_arrival();
  return first > bus_free_date_ ? clock_.cycle_at_or_after(first) : bus_free_;
}

// The next port, in the arbiter's order, with a request that has arrived by `date`; needs one.
std::size_t BusScheduler::choose(Picoseconds date) const {
  const std::vector<Picoseconds>& arrivals = queues_->arrivals();
  const bool in_turn = timing_.arbitration == MemoryArbitration::kRoundRobin;
  std::size_t id = in_turn ? last_served_ + 1 : 0;
  for (;; ++id) {
    if (id == arrivals.size()) id = 0;
    if (arrivals[id] <= date) return id;
  }
}

void BusScheduler::serve_until(Picoseconds date, bool inclusive, MemoryService& service) {
  while (!queues_->empty() && first_arrival() <= date) {
    const Cycles edge = next_edge();
    const Picoseconds at = clock_.date_of(edge);
    if (at > date || (at == date && !inclusive)) return;
    const std::size_t id = choose(at);
    const MemoryRequest request = queues_->pop(id, at);
    service.served(id, request);
    const Cycles transfer = transfer_time(*request.payload);
    taken_[id] += transfer;
    last_served_ = id;
    bus_free_ = edge + transfer;
    bus_free_date_ = clock_.date_of(bus_free_);
    service.answered(id, request, clock_.date_of(bus_free_ + timing_.latency));
  }
}

// The answer to whoever would be served next as things are.
Picoseconds BusScheduler::next_answer() {
  if (queues_->empty()) return MemoryQueues::kNever;
  const Cycles edge = next_edge();
  const MemoryRequest& next = queues_->head(choose(clock_.date_of(edge)));
  return clock_.date_of(edge + transfer_time(*next.payload) + timing_.latency);
}

Cycles BusScheduler::bus_taken(std::size_t port, Picoseconds date) {
  if (port != last_served_) return taken_[port];
  return taken_[port] - std::max(Cycles(0), bus_free_ - clock_.cycle_at_or_after(date));
}

Cycles BusScheduler::at_work(Picoseconds date) {
  const Cycles all = std::accumulate(taken_.begin(), taken_.end(), Cycles(0));
  return all - std::max(Cycles(0), bus_free_ - clock_.cycle_at_or_after(date));
}

}  // namespace parallax
