// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tlm_utils/multi_passthrough_target_socket.h>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <systemc>
#include <tlm>
#include <vector>

#include "tlm/clock_domain.hpp"
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
/// TLM-2.0 target, base protocol: b_transport, the four phases of nb_transport, transport_dbg; no DMI, no
/// byte enables. A port is one binding of the socket, in the order of binding.
class Memory final : public sc_core::sc_module {
 public:
  tlm_utils::multi_passthrough_target_socket<Memory> socket{"socket"};

  Memory(const sc_core::sc_module_name& name, const MemoryTiming& timing, const ClockDomain& clock);

  const MemoryPortStatistics& statistics(std::size_t port) const { return ports_[port].statistics; }
  std::size_t ports() const { return ports_.size(); }
  /// Cycles that the bus was taken for a port until now: what of `statistics(port).bus` has passed.
  Cycles bus_taken(std::size_t port) const;
  const ClockDomain& clock() const { return clock_; }
  /// Bytes per second that the bus carries at most.
  double usable_bandwidth() const;

 private:
  struct Request {
    ::tlm::tlm_generic_payload* payload;
    sc_core::sc_time arrival;
    sc_core::sc_event* blocking = nullptr;  // of a b_transport caller
  };
  struct Port {
    std::deque<Request> queue;
    ::tlm::tlm_generic_payload* refused = nullptr;  // BEGIN_REQ not answered with END_REQ yet
    sc_core::sc_time refused_arrival;
    std::deque<Request> answers;
    bool answering = false;           // BEGIN_RESP sent, END_RESP not seen
    sc_core::sc_time answered_until;  // END_RESP's own time; the next BEGIN_RESP is not earlier
    MemoryPortStatistics statistics;
  };

  void end_of_elaboration() override;
  ::tlm::tlm_sync_enum nb_transport_fw(int id, ::tlm::tlm_generic_payload& payload, ::tlm::tlm_phase& phase,
                                       sc_core::sc_time& delay);
  void b_transport(int id, ::tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  unsigned transport_dbg(int id, ::tlm::tlm_generic_payload& payload);

  void serve();
  void answer();
  Port* choose(const sc_core::sc_time& now, sc_core::sc_time& next_arrival);
  void begin_response(std::size_t id);
  bool access(::tlm::tlm_generic_payload& payload);

  struct Free {
    void operator()(void* memory) const;
  };

  const MemoryTiming timing_;
  const ClockDomain& clock_;
  std::unique_ptr<std::uint8_t, Free> bytes_;
  std::vector<Port> ports_;
  std::size_t last_served_ = 0;
  Cycles bus_free_{0};
  std::multimap<sc_core::sc_time, std::pair<std::size_t, Request>> under_way_;
  sc_core::sc_event serve_;
  sc_core::sc_event answer_;
};

}  // namespace parallax
