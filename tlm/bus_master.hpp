// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tlm_utils/peq_with_cb_and_phase.h>
#include <tlm_utils/simple_initiator_socket.h>
#include <cstdint>
#include <functional>
#include <systemc>
#include <tlm>

#include "tlm/payload_pool.hpp"

namespace parallax {

/// The request and response side of a DMA engine: a TLM-2.0 initiator that keeps to the base protocol, with
/// several requests on the way.
class BusMaster final : public sc_core::sc_module {
 public:
  tlm_utils::simple_initiator_socket<BusMaster> socket{"socket"};

  /// `outstanding` >= 1: requests sent and not answered. `response` is told of each answer when it is there.
  BusMaster(const sc_core::sc_module_name& name, std::size_t burst_bytes, std::uint32_t outstanding,
            std::function<void(::tlm::tlm_generic_payload&)> response);

  PayloadPool& pool() { return pool_; }
  /// For a thread: returns when a request may be sent, which is when fewer than `outstanding` are on the way.
  void wait_for_place();
  /// For a thread, after wait_for_place(): sends the payload now and returns when the target has taken it. An
  /// answer that is an error is reported with SC_REPORT_ERROR /parallax/dma/response.
  void send(::tlm::tlm_generic_payload& payload);
  /// Functional access, in no time.
  void read_now(std::uint64_t address, std::uint8_t* data, std::size_t size);

  std::uint32_t in_flight() const { return in_flight_; }

  /// Time that requests were under way until now, summed over them: at most `outstanding` times the present
  /// time.
  sc_core::sc_time occupied() const;

 private:
  ::tlm::tlm_sync_enum nb_transport_bw(::tlm::tlm_generic_payload& payload, ::tlm::tlm_phase& phase,
                                       sc_core::sc_time& delay);
  void phase_due(::tlm::tlm_generic_payload& payload, const ::tlm::tlm_phase& phase);
  bool take_phase(::tlm::tlm_generic_payload& payload, const ::tlm::tlm_phase& phase);
  void end_response(::tlm::tlm_generic_payload& payload);
  void answered(::tlm::tlm_generic_payload& payload);
  void change_in_flight(int by);

  PayloadPool pool_;
  std::uint32_t outstanding_;
  std::function<void(::tlm::tlm_generic_payload&)> response_;
  tlm_utils::peq_with_cb_and_phase<BusMaster> later_;  // phases that the target dated in the future
  std::uint32_t in_flight_ = 0;
  sc_core::sc_time occupied_;
  sc_core::sc_time occupied_until_;
  ::tlm::tlm_generic_payload* requesting_ = nullptr;  // sent, END_REQ not seen
  sc_core::sc_event moved_;
};

}  // namespace parallax
