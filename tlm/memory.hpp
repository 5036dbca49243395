// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tlm_utils/multi_passthrough_target_socket.h>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <systemc>
#include <tlm>
#include <vector>

#include "tlm/clock_domain.hpp"
#include "tlm/ring.hpp"
#include "tlm/units.hpp"

namespace parallax {

struct MemoryTiming {
  enum class Arbitration { kRoundRobin, kFixedPriority };

  Bytes size{64ll << 20};
  Bytes bytes_per_cycle{8};       ///< peak, on the data bus, in cycles of the memory's clock
  std::int64_t efficiency = 100;  ///< percent of the peak that is usable, 1..100
  Cycles latency{0};              ///< from the start of service to the first data
  std::uint32_t queue_depth = 4;  ///< requests waiting per port; a further one is not taken yet
  Arbitration arbitration = Arbitration::kRoundRobin;  ///< fixed priority: the port bound first wins
  bool holds_data = true;  ///< false: times requests only; what is written is lost, what is read is left alone
};

/// What went through one port.
struct MemoryPortStatistics {
  std::uint64_t read_bytes = 0;
  std::uint64_t written_bytes = 0;
  std::uint64_t requests = 0;
  Cycles bus;                    ///< cycles that the data bus was taken
  sc_core::sc_time latency_sum;  ///< from BEGIN_REQ to BEGIN_RESP
  sc_core::sc_time latency_largest;

  std::uint64_t bytes() const { return read_bytes + written_bytes; }
};

/// A memory with several ports: one data bus, a fixed latency, an arbiter, a queue a port. A request takes
/// the bus for ceil(bytes / (bytes_per_cycle * efficiency)) cycles, one after the other without a gap, and is
/// answered `latency` plus that time after its service began. Answers keep a port's order.
///
/// Whom an edge of the clock serves is decided when that edge is over and everything that arrived by then is known,
/// whatever the order in which the kernel runs the initiators. Nothing needs the decision earlier but a request that
/// waits for a place in the queue: then it is taken at the edge, a delta cycle after what came there first. Decisions
/// wait for the first answer that has to be given; at its date all that are known are given, the others with their
/// dates as timing annotation. So a kernel event serves one request or several.
///
/// TLM-2.0 target, base protocol: b_transport, the four phases of nb_transport, transport_dbg; no DMI, no
/// byte enables. A port is one binding of the socket, in the order of binding.
class Memory final : public sc_core::sc_module {
 public:
  tlm_utils::multi_passthrough_target_socket<Memory> socket{"socket"};

  Memory(const sc_core::sc_module_name& name, const MemoryTiming& timing, const ClockDomain& clock);

  /// What was served until now.
  const MemoryPortStatistics& statistics(std::size_t port) const;
  std::size_t ports() const { return arbiter_.ports.size(); }
  /// Cycles that the bus was taken for a port until now: what of `statistics(port).bus` has passed.
  Cycles bus_taken(std::size_t port) const;
  const ClockDomain& clock() const { return clock_; }
  /// Bytes per second that the bus carries at most.
  double usable_bandwidth() const;

 private:
  static constexpr Picoseconds kNever{std::numeric_limits<std::int64_t>::max()};

  struct Request {
    ::tlm::tlm_generic_payload* payload = nullptr;
    Picoseconds arrival;
    Cycles transfer;                        // on the bus
    sc_core::sc_event* blocking = nullptr;  // of a b_transport caller
  };
  struct Answer {
    Request request;
    Picoseconds ready;
    std::size_t port = 0;
  };
  struct Told {  // an answer ahead of its date
    Picoseconds date;
    Picoseconds latency;
  };
  struct Port {
    Ring<Request> queue;
    ::tlm::tlm_generic_payload* refused = nullptr;  // BEGIN_REQ not answered with END_REQ yet
    Picoseconds refused_arrival;
    Cycles refused_transfer;
    bool answering = false;      // BEGIN_RESP sent, END_RESP not seen
    Picoseconds answered_until;  // END_RESP's own time; the next BEGIN_RESP is not earlier
    Ring<Answer> held;           // wait for the END_RESP
    Ring<Told> told;
    MemoryPortStatistics statistics;  // until the first date in `told`
  };
  struct Taken {
    std::size_t port;
    ::tlm::tlm_generic_payload* payload;
    Picoseconds arrival;
  };
  // What the decisions of the past add up to.
  struct Arbiter {
    std::vector<Port> ports;
    std::vector<Picoseconds> arrivals;  // of the first request in each queue, or kNever
    Picoseconds first_arrival = kNever;  // of all
    std::size_t last_served = 0;
    Cycles bus_free{0};
    Picoseconds bus_free_date;
    Ring<Answer> answers;      // not told yet, in their order
    std::size_t refused = 0;   // on all ports
    std::vector<Taken> taken;  // refused requests that have found their place, to be told
  };

  void end_of_elaboration() override;
  ::tlm::tlm_sync_enum nb_transport_fw(int id, ::tlm::tlm_generic_payload& payload, ::tlm::tlm_phase& phase,
                                       sc_core::sc_time& delay);
  void b_transport(int id, ::tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  unsigned transport_dbg(int id, ::tlm::tlm_generic_payload& payload);

  void run();
  void enqueue(std::size_t id, const Request& request);
  void end_requests(Picoseconds now);
  void begin_response(const Answer& answer, Picoseconds now);
  void count_answers(Port& port, Picoseconds now) const;
  void wake_in_time();
  void wake_at(Picoseconds date);
  void serve_until(Picoseconds date, bool inclusive) const;
  void serve(std::size_t id, Cycles edge) const;
  Cycles next_edge() const;
  std::size_t choose(Picoseconds date) const;
  Cycles transfer_time(const ::tlm::tlm_generic_payload& payload);
  bool access(::tlm::tlm_generic_payload& payload) const;

  struct Free {
    void operator()(void* memory) const;
  };

  const MemoryTiming timing_;
  const ClockDomain& clock_;
  std::unique_ptr<std::uint8_t, Free> bytes_;
  mutable Arbiter arbiter_;  // decisions are made late, at the latest when somebody asks
  sc_core::sc_event wake_;
  Picoseconds wake_date_ = kNever;  // it has been notified for
  std::size_t held_ = 0;  // answers that wait for an END_RESP, on all ports
  std::int64_t last_length_ = 0;  // bytes: nearly all requests have the length of the one before
  Cycles last_transfer_;
  bool running_ = false;
  bool inclusive_ = false;  // the next run decides about the present edge, too
};

}  // namespace parallax
