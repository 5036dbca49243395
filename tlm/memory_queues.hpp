// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <systemc>
#include <tlm>
#include <utility>
#include <vector>

#include "tlm/ring.hpp"
#include "tlm/units.hpp"

namespace parallax {

/// Which port a memory serves when several wait.
enum class MemoryArbitration {
  kRoundRobin,     ///< in turn
  kFixedPriority,  ///< always the first in the order of binding
};

/// A request at a memory's port.
struct MemoryRequest {
  ::tlm::tlm_generic_payload* payload = nullptr;
  Picoseconds arrival;                    ///< date of BEGIN_REQ, or of the blocking call
  sc_core::sc_event* blocking = nullptr;  ///< of a b_transport caller
};

/// The requests that wait at the ports of a memory: a queue a port, and behind a full one a request that is
/// not taken yet.
class MemoryQueues {
 public:
  static constexpr Picoseconds kNever{std::numeric_limits<std::int64_t>::max()};
  struct Taken {  ///< a request that was not taken at once and now is
    std::size_t port;
    MemoryRequest request;
    Picoseconds date;  ///< when its slot was free
  };

  explicit MemoryQueues(std::uint32_t depth) : depth_(depth) {}

  void set_ports(std::size_t number) {
    ports_.resize(number);
    arrivals_.resize(number, kNever);
  }
  std::size_t ports() const { return ports_.size(); }
  bool room(std::size_t port) const { return ports_[port].queue.size() < depth_; }
  bool empty() const { return waiting_ == 0; }
  bool empty(std::size_t port) const { return ports_[port].queue.empty(); }
  /// Needs one that waits.
  const MemoryRequest& head(std::size_t port) const { return ports_[port].queue.front(); }
  /// When the second request of the queue has arrived or will, or kNever; one that is refused counts.
  Picoseconds second_arrival(std::size_t port) const {
    const PortQueue& p = ports_[port];
    return p.queue.size() > 1             ? p.queue[1].arrival
           : p.refused.payload != nullptr ? p.refused.arrival
                                          : kNever;
  }
  /// Dates at which the first request of each queue has arrived or will, or kNever.
  const std::vector<Picoseconds>& arrivals() const { return arrivals_; }

  /// Blocking callers are not held back by a full queue. One whose date is ahead of the kernel's time makes
  /// way for blocking calls that come later with an earlier date: none of them has been decided about.
  /// Says whether the request is the first of its queue now.
  bool push(std::size_t port, const MemoryRequest& request) {
    Ring<MemoryRequest>& queue = ports_[port].queue;
    MemoryRequest& last = queue.add();
    last.payload = request.payload;
    last.arrival = request.arrival;
    last.blocking = request.blocking;
    ++waiting_;
    std::size_t place = queue.size() - 1;
    for (; request.blocking != nullptr && place > 0 && queue[place - 1].arrival > request.arrival; --place)
      std::swap(queue[place - 1], queue[place]);
    if (place == 0) arrivals_[port] = request.arrival;
    return place == 0;
  }
  /// The queue has no room, and no other request is refused.
  void refuse(std::size_t port, const MemoryRequest& request) {
    ports_[port].refused = request;
    ++refused_;
  }
  bool has_refused(std::size_t port) const { return ports_[port].refused.payload != nullptr; }
  bool any_refused() const { return refused_ != 0; }

  /// The first request leaves its queue at `date`; one that was refused gets its slot.
  MemoryRequest pop(std::size_t id, Picoseconds date) {
    PortQueue& port = ports_[id];
    const MemoryRequest request = port.queue.front();
    port.queue.pop_front();
    --waiting_;
    if (port.refused.payload != nullptr) {
      const MemoryRequest taken = std::exchange(port.refused, {});
      --refused_;
      port.queue.push_back(taken);
      ++waiting_;
      taken_.push_back({id, taken, date});
    }
    arrivals_[id] = port.queue.empty() ? kNever : port.queue.front().arrival;
    return request;
  }
  /// Refused requests that have got a slot since the last call.
  std::vector<Taken> newly_taken() { return std::exchange(taken_, {}); }
  bool any_newly_taken() const { return !taken_.empty(); }

 private:
  struct PortQueue {
    Ring<MemoryRequest> queue;
    MemoryRequest refused;  // BEGIN_REQ not answered with END_REQ yet
  };
  std::vector<PortQueue> ports_;
  std::vector<Picoseconds> arrivals_;
  std::size_t waiting_ = 0;  // in all queues
  std::size_t refused_ = 0;  // on all ports
  std::vector<Taken> taken_;
  std::uint32_t depth_;
};

}  // namespace parallax
