// SPDX-License-Identifier: Apache-2.0
#include "tlm/bus_master.hpp"

#include <fmt/format.h>

#include <utility>

namespace parallax {

BusMaster::BusMaster(const sc_core::sc_module_name& name, std::size_t burst_bytes, std::uint32_t outstanding,
                     std::function<void(::tlm::tlm_generic_payload&, const sc_core::sc_time&)> response)
    : sc_module(name), pool_(burst_bytes), outstanding_(outstanding), response_(std::move(response)) {
  socket.register_nb_transport_bw(this, &BusMaster::nb_transport_bw);
}

void BusMaster::send(::tlm::tlm_generic_payload& payload) {
  while (in_flight_ == outstanding_) sc_core::wait(moved_);
  ++in_flight_;
  requesting_ = &payload;
  ::tlm::tlm_phase phase = ::tlm::BEGIN_REQ;
  sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
  switch (socket->nb_transport_fw(payload, phase, delay)) {
    case ::tlm::TLM_COMPLETED:
      requesting_ = nullptr;
      answered(payload, delay);
      break;
    case ::tlm::TLM_UPDATED:
      requesting_ = nullptr;
      if (phase == ::tlm::BEGIN_RESP) {
        answered(payload, delay);
        phase = ::tlm::END_RESP;
        socket->nb_transport_fw(payload, phase, delay);
      } else if (delay > sc_core::SC_ZERO_TIME) {
        sc_core::wait(delay);
      }
      break;
    case ::tlm::TLM_ACCEPTED:
      break;
  }
  while (requesting_ != nullptr) sc_core::wait(moved_);
}

::tlm::tlm_sync_enum BusMaster::nb_transport_bw(::tlm::tlm_generic_payload& payload, ::tlm::tlm_phase& phase,
                                                sc_core::sc_time& delay) {
  if (requesting_ == &payload) requesting_ = nullptr;  // END_REQ, or BEGIN_RESP that implies it
  moved_.notify(delay);
  if (phase != ::tlm::BEGIN_RESP) return ::tlm::TLM_ACCEPTED;
  answered(payload, delay);
  phase = ::tlm::END_RESP;
  return ::tlm::TLM_COMPLETED;
}

void BusMaster::answered(::tlm::tlm_generic_payload& payload, const sc_core::sc_time& delay) {
  if (payload.is_response_error()) {
    SC_REPORT_ERROR("/parallax/dma/response",
                    fmt::format("{}: {} bytes at {:#x}: {}", name(), payload.get_data_length(),
                                payload.get_address(), payload.get_response_string())
                        .c_str());
  }
  --in_flight_;
  moved_.notify(delay);
  response_(payload, sc_core::sc_time_stamp() + delay);
  payload.release();
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
