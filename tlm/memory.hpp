// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tlm_utils/multi_passthrough_target_socket.h>
#include <cstdint>
#include <memory>
#include <string>
#include <systemc>
#include <tlm>
#include <vector>

#include "tlm/memory_queues.hpp"
#include "tlm/memory_scheduler.hpp"
#include "tlm/ring.hpp"
#include "tlm/units.hpp"

namespace parallax {

struct MemoryTargetConfig {
  Bytes size{64ll << 20};
  std::uint32_t queue_depth = 4;  ///< requests waiting per port; a further one is not taken yet
  bool holds_data =
      true;  ///< false: times requests only; what is written is lost, what is read is left alone
};

/// What went through one port.
struct MemoryPortStatistics {
  std::uint64_t read_bytes = 0;     ///< of requests without an error
  std::uint64_t written_bytes = 0;  ///< likewise
  std::uint64_t requests = 0;
  sc_core::sc_time latency_sum;  ///< from BEGIN_REQ to BEGIN_RESP
  sc_core::sc_time latency_largest;

  std::uint64_t bytes() const { return read_bytes + written_bytes; }
};

/// A memory with several ports, each a queue of requests. What is served when is its scheduler's business: a
/// data bus with a fixed latency (BusScheduler), or a DRAM (DramScheduler). Answers keep the order of a
/// port's reads, and of its writes.
///
/// Nothing needs the scheduler's decisions when they fall, but a request that waits for a slot in the queue.
/// They wait for the first answer that has to be given; at its date all that are known are given, the others
/// with their dates as timing annotation. So a kernel event serves one request or several.
///
/// TLM-2.0 target, base protocol: b_transport, the four phases of nb_transport, transport_dbg; no DMI, no
/// byte enables. A port is one binding of the socket, in the order of binding.
///
/// The date of a call is the kernel's time with the delay that is passed. Blocking calls of one port are
/// served in the order of their dates, those of one date in that of the calls, so threads that share a port
/// may run ahead of the kernel (temporal decoupling) by different times. A blocking call returns at the date
/// of its answer with a delay of zero: it waits, as what others ask for until then has a share in that date.
class Memory : public sc_core::sc_module, private MemoryService {
 public:
  tlm_utils::multi_passthrough_target_socket<Memory> socket{"socket"};

  Memory(const sc_core::sc_module_name& name, const MemoryTargetConfig& config,
         std::unique_ptr<MemoryScheduler> scheduler);

  /// What was served until now.
  const MemoryPortStatistics& statistics(std::size_t port) const;
  std::size_t ports() const { return ports_.size(); }
  /// Cycles that the bus was taken for a port until now.
  Cycles bus_taken(std::size_t port) const;
  /// Cycles in which the memory was at work until now: on the bus, or with what has to precede it.
  Cycles at_work() const;
  /// What a DRAM's controller has done until now; none if it is no DRAM.
  const DramStatistics* commands() const;
  Cycles cycle_at_or_after(const sc_core::sc_time& time) const;
  /// Seconds that cycles of the memory's clock take.
  double seconds(Cycles cycles) const { return scheduler_->seconds(cycles); }
  /// Bytes per second that the bus carries at most.
  double usable_bandwidth() const { return scheduler_->usable_bandwidth(); }

 private:
  static constexpr Picoseconds kNever = MemoryQueues::kNever;

  struct Answer {
    MemoryRequest request;
    Picoseconds ready;
    std::size_t port = 0;
  };
  struct EarlyAnswer {  // given ahead of its date
    Picoseconds date;
    Picoseconds latency;
  };
  struct AnswerPort {
    bool answering = false;                                        // BEGIN_RESP sent, END_RESP not seen
    const ::tlm::tlm_generic_payload* answered_payload = nullptr;  // of the last BEGIN_RESP
    Picoseconds answered_until;  // END_RESP's own time; the next BEGIN_RESP is not earlier
    Ring<Answer> held;           // wait for the END_RESP
    Ring<EarlyAnswer> early;
    MemoryPortStatistics statistics;  // until the first date in `early`
  };

  void end_of_elaboration() override;
  ::tlm::tlm_sync_enum nb_transport_fw(int id, ::tlm::tlm_generic_payload& payload, ::tlm::tlm_phase& phase,
                                       sc_core::sc_time& delay);
  void b_transport(int id, ::tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  unsigned transport_dbg(int id, ::tlm::tlm_generic_payload& payload);

  void served(std::size_t port, const MemoryRequest& request) override;
  void answered(std::size_t port, const MemoryRequest& request, Picoseconds ready) override {
    Answer& answer = answers_.add();
    answer.request.payload = request.payload;
    answer.request.arrival = request.arrival;
    answer.request.blocking = request.blocking;
    answer.ready = ready;
    answer.port = port;
  }

  void run();
  void enqueue(std::size_t id, const MemoryRequest& request);
  void end_requests(Picoseconds now);
  void begin_response(const Answer& answer, Picoseconds now);
  void count_answers(AnswerPort& port, Picoseconds now) const;
  void wake_in_time();
  void wake_at(Picoseconds date);
  void serve_until(Picoseconds date, bool inclusive) const;
  bool access(::tlm::tlm_generic_payload& payload) const;

  struct Free {
    void operator()(void* memory) const;
  };

  const MemoryTargetConfig config_;
  const std::unique_ptr<MemoryScheduler> scheduler_;
  std::unique_ptr<std::uint8_t, Free> bytes_;
  MemoryQueues queues_;
  mutable std::vector<AnswerPort>
      ports_;             // decisions are made late, at the latest when the statistics are read
  Ring<Answer> answers_;  // not given yet, in the order of decisions
  sc_core::sc_event wake_;
  Picoseconds wake_date_ = kNever;  // it has been notified for
  std::size_t held_ = 0;            // answers that wait for an END_RESP, on all ports
  bool running_ = false;
  bool inclusive_ = false;  // the next run decides about the present edge, too
};

}  // namespace parallax
