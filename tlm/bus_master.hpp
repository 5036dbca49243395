// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tlm_utils/peq_with_cb_and_phase.h>
#include <tlm_utils/simple_initiator_socket.h>
#include <cstdint>
#include <optional>
#include <systemc>
#include <tlm>
#include <vector>

#include "tlm/latency_histogram.hpp"
#include "tlm/listeners.hpp"
#include "tlm/payload_pool.hpp"

namespace parallax {

/// What a bus master's requests have moved.
struct BusStatistics {
  std::uint64_t bytes = 0;
  std::uint64_t requests = 0;
};

class BusMaster;

/// A request without an answer.
struct BusRequest {
  bool write = false;
  std::uint64_t address = 0;
  std::uint64_t bytes = 0;
  sc_core::sc_time sent;
  bool taken = false;  ///< the target has ended the request's phase
};

/// A request that has been answered.
struct BusTransfer {
  bool write = false;
  std::uint64_t address = 0;
  std::uint64_t bytes = 0;
  sc_core::sc_time requested;
  sc_core::sc_time answered;  ///< now or in the future
};

/// Notified of each request of a bus master and of its answer, in the order in which they are sent and known.
class BusListener {
 public:
  virtual ~BusListener() = default;
  /// A request is sent at `time`, now or in the future.
  virtual void requested(const BusMaster& master, const sc_core::sc_time& time) = 0;
  virtual void transferred(const BusMaster& master, const BusTransfer& transfer) = 0;
};

/// Notified by a bus master how its requests fare.
class BusClient {
 public:
  virtual ~BusClient() = default;
  /// The target has taken the request that was sent last, at `time`, which may be in the future.
  virtual void taken(const sc_core::sc_time& time) = 0;
  /// The answer to a request comes at `time`, now or in the future. `was_full`: until this call,
  /// BusMaster::ready() was false because of it.
  virtual void answered(const sc_core::sc_time& time, bool was_full) = 0;
};

/// The request and response side of a DMA engine: a TLM-2.0 initiator that keeps to the base protocol, with
/// several requests on the way. A request whose date is known is sent ahead of it, with the date as timing
/// annotation, and a target may answer ahead likewise, so that no kernel event is spent on either.
class BusMaster final : public sc_core::sc_module {
 public:
  tlm_utils::simple_initiator_socket<BusMaster> socket{"socket"};

  /// `outstanding` >= 1: requests under way at once.
  BusMaster(const sc_core::sc_module_name& name, std::size_t burst_bytes, std::uint32_t outstanding,
            BusClient& client);

  PayloadPool& pool() { return pool_; }
  /// Whether it is known when a request may be sent: the target has taken the one before, and it is known
  /// when fewer than `outstanding` are under way. When not, BusClient says when that has changed.
  bool ready() const { return requesting_ == nullptr && requests_.size() < outstanding_; }
  /// Needs ready(). When fewer than `outstanding` are under way: that date, or one in the past.
  sc_core::sc_time credit_at() const;
  /// Needs ready(). Sends a payload of the pool with its date, `time`: not before the present, credit_at(),
  /// and when the request before was taken. An answer that is an error is reported with SC_REPORT_ERROR
  /// /parallax/dma/response; one to a request that is not under way (it was answered before), or before that
  /// of an older request, with /parallax/dma/phase.
  void send(::tlm::tlm_generic_payload& payload, const sc_core::sc_time& time);
  /// Functional accesses, in no time.
  void read_now(std::uint64_t address, std::uint8_t* data, std::size_t size) {
    access_now(::tlm::TLM_READ_COMMAND, address, data, size);
  }
  void write_now(std::uint64_t address, std::uint8_t* data, std::size_t size) {
    access_now(::tlm::TLM_WRITE_COMMAND, address, data, size);
  }

  /// One more listener, or one less (Listeners).
  void add_listener(BusListener& listener) { listeners_.add(listener); }
  void remove_listener(BusListener& listener) { listeners_.remove(listener); }

  /// Requests whose answer is not known.
  std::size_t in_flight() const { return requests_.size(); }
  /// The oldest of these, if there is one.
  std::optional<BusRequest> oldest() const;

  /// Time that requests were under way until now, summed over them: at most `outstanding` times the present
  /// time.
  sc_core::sc_time occupied() const;
  /// Of requests answered until now.
  BusStatistics statistics() const;
  /// From request to answer, of all requests whose answer is known.
  const LatencyHistogram& latencies() const { return latencies_; }

 private:
  struct Request {
    ::tlm::tlm_generic_payload* payload;
    sc_core::sc_time time;

    Request(::tlm::tlm_generic_payload* of, const sc_core::sc_time& at) : payload(of), time(at) {}
  };
  struct Span {
    sc_core::sc_time begin;
    sc_core::sc_time end;
    std::uint64_t bytes;

    Span(const sc_core::sc_time& from, const sc_core::sc_time& to, std::uint64_t number)
        : begin(from), end(to), bytes(number) {}
  };

  void access_now(::tlm::tlm_command command, std::uint64_t address, std::uint8_t* data, std::size_t size);
  ::tlm::tlm_sync_enum nb_transport_bw(::tlm::tlm_generic_payload& payload, ::tlm::tlm_phase& phase,
                                       sc_core::sc_time& delay);
  void phase_due(::tlm::tlm_generic_payload& payload, const ::tlm::tlm_phase& phase);
  void request_ends(::tlm::tlm_generic_payload& payload, const sc_core::sc_time& time);
  void answered(std::vector<Request>::iterator request, const sc_core::sc_time& time);
  std::vector<Request>::iterator find(const ::tlm::tlm_generic_payload& payload);
  bool is_next(const ::tlm::tlm_generic_payload& payload, std::vector<Request>::iterator request) const;

  PayloadPool pool_;
  std::uint32_t outstanding_;
  BusClient& client_;
  Listeners<BusListener> listeners_;
  tlm_utils::peq_with_cb_and_phase<BusMaster>
      later_;                      // answers that came with the request and are dated later
  std::vector<Request> requests_;  // not answered, in order
  std::vector<Span> ending_;       // of those whose answer is known and was to come, by `end`
  sc_core::sc_time occupied_;      // by those before
  BusStatistics past_;             // likewise
  LatencyHistogram latencies_;
  ::tlm::tlm_generic_payload* requesting_ = nullptr;  // sent, END_REQ not seen
};

}  // namespace parallax
