// SPDX-License-Identifier: Apache-2.0
#include "tlm/bus_master.hpp"

#include <fmt/format.h>

#include <utility>

namespace parallax {

BusMaster::BusMaster(const sc_core::sc_module_name& name, std::size_t burst_bytes, std::uint32_t outstanding,
                     std::function<void(::tlm::tlm_generic_payload&)> response)
    : sc_module(name),
      pool_(burst_bytes),
      outstanding_(outstanding),
      response_(std::move(response)),
      later_(this, &BusMaster::phase_due) {
  socket.register_nb_transport_bw(this, &BusMaster::nb_transport_bw);
}

void BusMaster::wait_for_place() {
  while (in_flight_ == outstanding_) sc_core::wait(moved_);
}

void BusMaster::send(::tlm::tlm_generic_payload& payload) {
  change_in_flight(1);
  requesting_ = &payload;
  ::tlm::tlm_phase phase = ::tlm::BEGIN_REQ;
  sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
  const ::tlm::tlm_sync_enum status = socket->nb_transport_fw(payload, phase, delay);
  if (status != ::tlm::TLM_ACCEPTED) {
    if (delay > sc_core::SC_ZERO_TIME) sc_core::wait(delay);
    requesting_ = nullptr;
    if (status == ::tlm::TLM_COMPLETED) {
      answered(payload);
    } else if (phase == ::tlm::BEGIN_RESP) {
      end_response(payload);
    }
  }
  while (requesting_ != nullptr) sc_core::wait(moved_);
}

::tlm::tlm_sync_enum BusMaster::nb_transport_bw(::tlm::tlm_generic_payload& payload, ::tlm::tlm_phase& phase,
                                                sc_core::sc_time& delay) {
  if (delay > sc_core::SC_ZERO_TIME) {
    later_.notify(payload, phase, delay);
    return ::tlm::TLM_ACCEPTED;
  }
  if (!take_phase(payload, phase)) return ::tlm::TLM_ACCEPTED;
  answered(payload);
  phase = ::tlm::END_RESP;
  return ::tlm::TLM_COMPLETED;
}

void BusMaster::phase_due(::tlm::tlm_generic_payload& payload, const ::tlm::tlm_phase& phase) {
  if (take_phase(payload, phase)) end_response(payload);
}

// Whether the phase is an answer.
bool BusMaster::take_phase(::tlm::tlm_generic_payload& payload, const ::tlm::tlm_phase& phase) {
  if (requesting_ == &payload) requesting_ = nullptr;  // END_REQ, or BEGIN_RESP that implies it
  moved_.notify(sc_core::SC_ZERO_TIME);
  return phase == ::tlm::BEGIN_RESP;
}

void BusMaster::end_response(::tlm::tlm_generic_payload& payload) {
  ::tlm::tlm_phase phase = ::tlm::END_RESP;
  sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
  socket->nb_transport_fw(payload, phase, delay);
  answered(payload);
}

void BusMaster::answered(::tlm::tlm_generic_payload& payload) {
  if (payload.is_response_error()) {
    SC_REPORT_ERROR("/parallax/dma/response",
                    fmt::format("{}: {} bytes at {:#x}: {}", name(), payload.get_data_length(),
                                payload.get_address(), payload.get_response_string())
                        .c_str());
  }
  change_in_flight(-1);
  moved_.notify(sc_core::SC_ZERO_TIME);
  response_(payload);
  payload.release();
}

void BusMaster::change_in_flight(int by) {
  occupied_ = occupied();
  occupied_until_ = sc_core::sc_time_stamp();
  in_flight_ = static_cast<std::uint32_t>(static_cast<int>(in_flight_) + by);
}

sc_core::sc_time BusMaster::occupied() const {
  return occupied_ + (sc_core::sc_time_stamp() - occupied_until_) * in_flight_;
}

void BusMaster::read_now(std::uint64_t address, std::uint8_t* data, std::size_t size) {
  ::tlm::tlm_generic_payload payload;
  payload.set_command(::tlm::TLM_READ_COMMAND);
  payload.set_address(address);
  payload.set_data_ptr(data);
  payload.set_data_length(static_cast<unsigned>(size));
  payload.set_streaming_width(static_cast<unsigned>(size));
  if (socket->transport_dbg(payload) != size) {
    SC_REPORT_ERROR("/parallax/dma/debug",
                    fmt::format("{}: no {} bytes at {:#x}", name(), size, address).c_str());
  }
}

}  // namespace parallax
