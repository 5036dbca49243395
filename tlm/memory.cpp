// SPDX-License-Identifier: Apache-2.0
#include "tlm/memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "tlm/error.hpp"

namespace parallax {

Memory::Memory(const sc_core::sc_module_name& name, const MemoryTiming& timing, const ClockDomain& clock)
    : sc_module(name), timing_(timing), clock_(clock) {
  if (timing.holds_data) {
    // calloc: pages that nobody writes take no memory.
    bytes_.reset(static_cast<std::uint8_t*>(std::calloc(static_cast<std::size_t>(timing.size.count()), 1)));
    if (bytes_ == nullptr) {
      throw UserError(fmt::format("this computer cannot hold a memory of {} bytes", timing.size.count()));
    }
  }
  socket.register_nb_transport_fw(this, &Memory::nb_transport_fw);
  socket.register_b_transport(this, &Memory::b_transport);
  socket.register_transport_dbg(this, &Memory::transport_dbg);
  SC_HAS_PROCESS(Memory);
  SC_METHOD(serve);
  sensitive << serve_;
  dont_initialize();
  SC_METHOD(answer);
  sensitive << answer_;
  dont_initialize();
}

void Memory::Free::operator()(void* memory) const { std::free(memory); }

void Memory::end_of_elaboration() {
  ports_.resize(socket.size());
  last_served_ = ports_.empty() ? 0 : ports_.size() - 1;  // the first turn is the first port's
}

Cycles Memory::bus_taken(std::size_t port) const {
  const Cycles to_come = port == last_served_ ? std::max(Cycles(0), bus_free_ - clock_.now()) : Cycles(0);
  return ports_[port].statistics.bus - to_come;
}

double Memory::usable_bandwidth() const {
  return static_cast<double>(timing_.bytes_per_cycle.count()) * static_cast<double>(timing_.efficiency) /
         100.0 * static_cast<double>(clock_.frequency().count());
}

::tlm::tlm_sync_enum Memory::nb_transport_fw(int id, ::tlm::tlm_generic_payload& payload,
                                             ::tlm::tlm_phase& phase, sc_core::sc_time& delay) {
  Port& port = ports_[static_cast<std::size_t>(id)];
  if (phase == ::tlm::END_RESP) {
    port.answering = false;
    port.answered_until = sc_core::sc_time_stamp() + delay;
    if (!port.answers.empty()) answer_.notify(delay);
    return ::tlm::TLM_COMPLETED;
  }
  if (phase != ::tlm::BEGIN_REQ) {
    SC_REPORT_ERROR("/parallax/memory/phase", "a request must begin with BEGIN_REQ and end with END_RESP");
    return ::tlm::TLM_COMPLETED;
  }
  if (port.refused != nullptr) {
    SC_REPORT_ERROR("/parallax/memory/phase", "a second BEGIN_REQ before the END_REQ of the first");
    return ::tlm::TLM_COMPLETED;
  }
  payload.acquire();
  const sc_core::sc_time arrival = sc_core::sc_time_stamp() + delay;
  if (port.queue.size() >= timing_.queue_depth) {
    port.refused = &payload;
    port.refused_arrival = arrival;
    return ::tlm::TLM_ACCEPTED;
  }
  port.queue.push_back({&payload, arrival});
  serve_.notify(delay);
  phase = ::tlm::END_REQ;
  return ::tlm::TLM_UPDATED;
}

void Memory::b_transport(int id, ::tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  sc_core::sc_event done;
  ports_[static_cast<std::size_t>(id)].queue.push_back({&payload, sc_core::sc_time_stamp() + delay, &done});
  serve_.notify(delay);
  delay = sc_core::SC_ZERO_TIME;
  sc_core::wait(done);
}

unsigned Memory::transport_dbg(int, ::tlm::tlm_generic_payload& payload) {
  return timing_.holds_data && access(payload) ? payload.get_data_length() : 0;
}

bool Memory::access(::tlm::tlm_generic_payload& payload) {
  const auto size = static_cast<std::uint64_t>(timing_.size.count());
  if (payload.get_address() > size || payload.get_data_length() > size - payload.get_address()) {
    payload.set_response_status(::tlm::TLM_ADDRESS_ERROR_RESPONSE);
    return false;
  }
  if (payload.get_byte_enable_ptr() != nullptr) {
    payload.set_response_status(::tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE);
    return false;
  }
  if (payload.get_streaming_width() < payload.get_data_length()) {
    payload.set_response_status(::tlm::TLM_BURST_ERROR_RESPONSE);
    return false;
  }
  if (timing_.holds_data) {
    std::uint8_t* place = bytes_.get() + payload.get_address();
    if (payload.is_read()) std::memcpy(payload.get_data_ptr(), place, payload.get_data_length());
    if (payload.is_write()) std::memcpy(place, payload.get_data_ptr(), payload.get_data_length());
  }
  payload.set_response_status(::tlm::TLM_OK_RESPONSE);
  return true;
}

// The next port with a request that has arrived, in the arbiter's order; else when the next one will.
Memory::Port* Memory::choose(const sc_core::sc_time& now, sc_core::sc_time& next_arrival) {
  const bool in_turn = timing_.arbitration == MemoryTiming::Arbitration::kRoundRobin;
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    const std::size_t id = in_turn ? (last_served_ + 1 + i) % ports_.size() : i;
    if (ports_[id].queue.empty()) continue;
    const sc_core::sc_time& arrival = ports_[id].queue.front().arrival;
    if (arrival <= now) {
      last_served_ = id;
      return &ports_[id];
    }
    next_arrival = std::min(next_arrival, arrival);
  }
  return nullptr;
}

// Gives the bus to one request.
void Memory::serve() {
  const sc_core::sc_time now = sc_core::sc_time_stamp();
  const Cycles edge = std::max(clock_.now(), bus_free_);
  if (clock_.time_of(edge) > now) {
    serve_.notify(clock_.time_of(edge) - now);
    return;
  }
  sc_core::sc_time next_arrival = sc_core::sc_max_time();
  Port* port = choose(now, next_arrival);
  if (port == nullptr) {
    if (next_arrival != sc_core::sc_max_time()) serve_.notify(next_arrival - now);
    return;
  }
  const Request request = port->queue.front();
  port->queue.pop_front();
  const std::int64_t bytes = request.payload->get_data_length();
  const std::int64_t per_cycle = timing_.bytes_per_cycle.count() * timing_.efficiency;
  const Cycles transfer((bytes * 100 + per_cycle - 1) / per_cycle);
  access(*request.payload);
  MemoryPortStatistics& statistics = port->statistics;
  ++statistics.requests;
  (request.payload->is_write() ? statistics.written_bytes : statistics.read_bytes) +=
      static_cast<std::uint64_t>(bytes);
  statistics.bus += transfer;
  bus_free_ = edge + transfer;
  const sc_core::sc_time ready = clock_.time_of(bus_free_ + timing_.latency);
  under_way_.emplace(ready, std::make_pair(last_served_, request));
  answer_.notify(under_way_.begin()->first - now);
  serve_.notify(clock_.time_of(bus_free_) - now);

  if (port->refused != nullptr) {
    ::tlm::tlm_generic_payload& taken = *std::exchange(port->refused, nullptr);
    port->queue.push_back({&taken, port->refused_arrival});
    ::tlm::tlm_phase phase = ::tlm::END_REQ;
    sc_core::sc_time delay = std::max(now, port->refused_arrival) - now;
    socket[static_cast<int>(last_served_)]->nb_transport_bw(taken, phase, delay);
  }
}

void Memory::answer() {
  const sc_core::sc_time now = sc_core::sc_time_stamp();
  while (!under_way_.empty() && under_way_.begin()->first <= now) {
    const auto [id, request] = under_way_.begin()->second;
    under_way_.erase(under_way_.begin());
    ports_[id].answers.push_back(request);
  }
  for (std::size_t id = 0; id < ports_.size(); ++id) begin_response(id);
  if (!under_way_.empty()) answer_.notify(under_way_.begin()->first - now);
}

void Memory::begin_response(std::size_t id) {
  Port& port = ports_[id];
  while (!port.answers.empty() && !port.answering) {
    const sc_core::sc_time now = sc_core::sc_time_stamp();
    if (port.answered_until > now) {
      answer_.notify(port.answered_until - now);
      return;
    }
    const Request request = port.answers.front();
    port.answers.pop_front();
    const sc_core::sc_time latency = now - request.arrival;
    port.statistics.latency_sum += latency;
    port.statistics.latency_largest = std::max(port.statistics.latency_largest, latency);
    if (request.blocking != nullptr) {
      request.blocking->notify();
      continue;
    }
    ::tlm::tlm_phase phase = ::tlm::BEGIN_RESP;
    sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
    const ::tlm::tlm_sync_enum status =
        socket[static_cast<int>(id)]->nb_transport_bw(*request.payload, phase, delay);
    port.answering =
        status == ::tlm::TLM_ACCEPTED || (status == ::tlm::TLM_UPDATED && phase != ::tlm::END_RESP);
    if (!port.answering) port.answered_until = now + delay;
    request.payload->release();
  }
}

}  // namespace parallax
