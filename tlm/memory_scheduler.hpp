// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tlm/dram_controller.hpp"
#include "tlm/memory_queues.hpp"
#include "tlm/units.hpp"

namespace parallax {

/// Notified of the scheduler's decisions.
class MemoryService {
 public:
  virtual ~MemoryService() = default;
  /// The request has left its queue: what it reads or writes happens now, before what is served after it.
  virtual void served(std::size_t port, const MemoryRequest& request) = 0;
  /// A request that was served is answered at `ready`. Those of one port and direction come in order.
  virtual void answered(std::size_t port, const MemoryRequest& request, Picoseconds ready) = 0;
};

/// Decides which of the requests that wait at a memory's ports is served when, and so when it is answered.
/// Nothing but the dates of requests enters into it: a decision about a date is made when that date is over
/// and everything that arrived by then is known, whatever the order in which the kernel runs the initiators.
class MemoryScheduler {
 public:
  virtual ~MemoryScheduler() = default;

  /// The ports are those of `queues`.
  virtual void bind(MemoryQueues& queues) = 0;
  /// Decides about all edges of its clock before `date`, and at it if `inclusive`. Takes what is served out
  /// of the queues.
  virtual void serve_until(Picoseconds date, bool inclusive, MemoryService& service) = 0;
  /// No answer that is not known yet is due before, if no further request comes; kNever when nothing waits.
  virtual Picoseconds next_answer() = 0;
  /// No refused request gets a slot before. When that is the present, it is decided about inclusively.
  virtual Picoseconds next_slot() = 0;

  /// Cycles until `date` in which the data bus was taken for a port; what was decided counts as it passes.
  virtual Cycles bus_taken(std::size_t port, Picoseconds date) = 0;
  /// Cycles until `date` in which the memory was at work: on the bus, or with what has to precede it.
  virtual Cycles at_work(Picoseconds date) = 0;
  virtual Cycles cycle_at_or_after(Picoseconds date) const = 0;
  virtual double seconds(Cycles cycles) const = 0;
  /// Bytes per second that the bus carries at most.
  virtual double usable_bandwidth() const = 0;
  /// Of a DRAM; else none.
  virtual const DramStatistics* commands() const { return nullptr; }
};

}  // namespace parallax
