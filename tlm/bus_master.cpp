// SPDX-License-Identifier: Apache-2.0
#include "tlm/bus_master.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace parallax {

BusMaster::BusMaster(const sc_core::sc_module_name& name, std::size_t burst_bytes, std::uint32_t outstanding,
                     BusClient& client)
    : sc_module(name),
      pool_(burst_bytes),
      outstanding_(outstanding),
      client_(client),
      later_(this, &BusMaster::phase_due) {
  socket.register_nb_transport_bw(this, &BusMaster::nb_transport_bw);
}

sc_core::sc_time BusMaster::credit_at() const {
  const std::size_t sent = requests_.size() + ending_.size();
  return sent < outstanding_ ? sc_core::SC_ZERO_TIME : ending_[sent - outstanding_].end;
}

void BusMaster::send(::tlm::tlm_generic_payload& payload, const sc_core::sc_time& time) {
  requests_.emplace_back(&payload, time);
  requesting_ = &payload;
  for (BusListener* listener : listeners_) listener->requested(*this, time);
  const sc_core::sc_time& now = sc_core::sc_time_stamp();
  ::tlm::tlm_phase phase = ::tlm::BEGIN_REQ;
  sc_core::sc_time delay = time - now;
  const ::tlm::tlm_sync_enum status = socket->nb_transport_fw(payload, phase, delay);
  if (status == ::tlm::TLM_ACCEPTED) return;
  if (status == ::tlm::TLM_UPDATED && phase == ::tlm::END_REQ) {
    request_ends(payload, std::max(time, now + delay));
    return;
  }
  if (status == ::tlm::TLM_COMPLETED) phase = ::tlm::END_RESP;
  later_.notify(payload, phase, std::max(time, now + delay) - now);
}

::tlm::tlm_sync_enum BusMaster::nb_transport_bw(::tlm::tlm_generic_payload& payload, ::tlm::tlm_phase& phase,
                                                sc_core::sc_time& delay) {
  const sc_core::sc_time& now = sc_core::sc_time_stamp();
  if (phase == ::tlm::END_REQ) {
    if (requesting_ == &payload) request_ends(payload, std::max(find(payload)->time, now + delay));
    return ::tlm::TLM_ACCEPTED;
  }
  if (phase != ::tlm::BEGIN_RESP) return ::tlm::TLM_ACCEPTED;  // a phase that may be ignored
  const auto request = find(payload);
  if (!is_next(payload, request)) return ::tlm::TLM_COMPLETED;
  const sc_core::sc_time date = std::max(request->time, now + delay);
  delay = date - now;
  const bool ends = requesting_ == &payload;
  request_ends(payload, date);
  answered(ends ? find(payload) : request, date);  // the client may have sent another one
  phase = ::tlm::END_RESP;
  return ::tlm::TLM_COMPLETED;
}

// An answer that came with the request is due: BEGIN_RESP, or END_RESP when the target has ended the
// transaction itself. It is kept until then, so that a target that answers at once sees the requests of all
// masters in order.
void BusMaster::phase_due(::tlm::tlm_generic_payload& payload, const ::tlm::tlm_phase& phase) {
  const sc_core::sc_time& now = sc_core::sc_time_stamp();
  if (!is_next(payload, find(payload))) return;
  request_ends(payload, now);
  if (phase == ::tlm::BEGIN_RESP) {
    ::tlm::tlm_phase end = ::tlm::END_RESP;
    sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
    socket->nb_transport_fw(payload, end, delay);
  }
  answered(find(payload), now);
}

// Whether this is the answer that is due. Bursts are handed on, and counted, in the order of their requests.
bool BusMaster::is_next(const ::tlm::tlm_generic_payload& payload,
                        std::vector<Request>::iterator request) const {
  const auto what = [](const ::tlm::tlm_generic_payload& of) {
    return fmt::format("the {} of {} bytes at {:#x}", of.is_write() ? "write" : "read", of.get_data_length(),
                       of.get_address());
  };
  if (request == requests_.end()) {
    SC_REPORT_ERROR("/parallax/dma/phase",
                    fmt::format("{}: the target answers {}, which is not under way: it was answered before",
                                name(), what(payload))
                        .c_str());
    return false;
  }
  if (request == requests_.begin()) return true;
  SC_REPORT_ERROR("/parallax/dma/phase",
                  fmt::format("{}: the target answers {} before {}, which was sent first; a port's requests "
                              "are to be answered in their order",
                              name(), what(payload), what(*requests_.front().payload))
                      .c_str());
  return false;
}

std::optional<BusRequest> BusMaster::oldest() const {
  if (requests_.empty()) return std::nullopt;
  const Request& request = requests_.front();
  return BusRequest{request.payload->is_write(), request.payload->get_address(),
                    request.payload->get_data_length(), request.time, requesting_ != request.payload};
}

// END_REQ, or an answer that implies it.
void BusMaster::request_ends(::tlm::tlm_generic_payload& payload, const sc_core::sc_time& time) {
  if (requesting_ != &payload) return;
  requesting_ = nullptr;
  client_.taken(time);
}

void BusMaster::answered(std::vector<Request>::iterator request, const sc_core::sc_time& time) {
  ::tlm::tlm_generic_payload& payload = *request->payload;
  if (payload.is_response_error()) {
    SC_REPORT_ERROR("/parallax/dma/response",
                    fmt::format("{}: {} bytes at {:#x}: {}", name(), payload.get_data_length(),
                                payload.get_address(), payload.get_response_string())
                        .c_str());
  }
  const bool was_full = requests_.size() == outstanding_;
  const sc_core::sc_time& now = sc_core::sc_time_stamp();
  auto past = ending_.begin();
  for (; past != ending_.end() && past->end < now; ++past) {
    occupied_ += past->end - past->begin;
    past_.bytes += past->bytes;
    ++past_.requests;
  }
  if (past != ending_.begin()) ending_.erase(ending_.begin(), past);
  if (ending_.empty() || ending_.back().end <= time) {
    ending_.emplace_back(request->time, time, payload.get_data_length());
  } else {
    const auto later =
        std::find_if(ending_.rbegin(), ending_.rend(), [&](const Span& s) { return s.end <= time; });
    ending_.emplace(later.base(), request->time, time, payload.get_data_length());
  }
  latencies_.add(time - request->time);
  if (listeners_.any()) {
    const BusTransfer transfer{payload.is_write(), payload.get_address(), payload.get_data_length(),
                               request->time, time};
    for (BusListener* listener : listeners_) listener->transferred(*this, transfer);
  }
  requests_.erase(request);
  payload.release();
  client_.answered(time, was_full);
}

std::vector<BusMaster::Request>::iterator BusMaster::find(const ::tlm::tlm_generic_payload& payload) {
  return std::find_if(requests_.begin(), requests_.end(),
                      [&](const Request& request) { return request.payload == &payload; });
}

sc_core::sc_time BusMaster::occupied() const {
  const sc_core::sc_time& now = sc_core::sc_time_stamp();
  sc_core::sc_time sum = occupied_;
  for (const Span& span : ending_) {
    if (span.begin < now) sum += std::min(now, span.end) - span.begin;
  }
  for (const Request& request : requests_) {
    if (request.time < now) sum += now - request.time;
  }
  return sum;
}

BusStatistics BusMaster::statistics() const {
  const sc_core::sc_time& now = sc_core::sc_time_stamp();
  BusStatistics all = past_;
  for (const Span& span : ending_) {
    if (span.end > now) continue;
    all.bytes += span.bytes;
    ++all.requests;
  }
  return all;
}

void BusMaster::access_now(::tlm::tlm_command command, std::uint64_t address, std::uint8_t* data,
                           std::size_t size) {
  ::tlm::tlm_generic_payload payload;
  payload.set_command(command);
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
