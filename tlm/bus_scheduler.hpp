// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tlm/clock_domain.hpp"
#include "tlm/memory_scheduler.hpp"

namespace parallax {

/// A memory that is one data bus with a fixed latency.
struct BusTiming {
  Bytes bytes_per_cycle{8};       ///< peak, on the data bus, in cycles of the memory's clock
  std::int64_t efficiency = 100;  ///< percent of the peak that is usable, 1..100
  Cycles latency{0};              ///< from the start of service to the first data
  MemoryArbitration arbitration = MemoryArbitration::kRoundRobin;
};

/// A request takes the bus for ceil(bytes / (bytes_per_cycle * efficiency)) cycles, one after the other
/// without a gap, and is answered `latency` plus that time after its service began. Its slot in the queue is
/// free when its service begins.
class BusScheduler final : public MemoryScheduler {
 public:
  BusScheduler(const BusTiming& timing, const ClockDomain& clock) : timing_(timing), clock_(clock) {}

  void bind(MemoryQueues& queues) override;
  void serve_until(Picoseconds date, bool inclusive, MemoryService& service) override;
  Picoseconds next_answer() override;
  Picoseconds next_slot() override { return clock_.date_of(next_edge()); }

  Cycles bus_taken(std::size_t port, Picoseconds date) override;
  Cycles at_work(Picoseconds date) override;
  Cycles cycle_at_or_after(Picoseconds date) const override { return clock_.cycle_at_or_after(date); }
  double seconds(Cycles cycles) const override { return clock_.seconds(cycles); }
  double usable_bandwidth() const override;

 private:
  Picoseconds first_arrival() const;
  Cycles next_edge() const;
  std::size_t choose(Picoseconds date) const;
  Cycles transfer_time(const ::tlm::tlm_generic_payload& payload);

  const BusTiming timing_;
  const ClockDomain& clock_;
  MemoryQueues* queues_ = nullptr;
  std::size_t last_served_ = 0;
  std::vector<Cycles> taken_;  // by port, all that was decided
  Cycles bus_free_{0};
  Picoseconds bus_free_date_;
  std::int64_t last_length_ = 0;  // bytes: nearly all requests have the length of the one before
  Cycles last_transfer_{1};
};

}  // namespace parallax
