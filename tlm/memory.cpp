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
    : sc_module(name),
      timing_(timing),
      clock_(clock),
      never_(sc_core::sc_max_time()),
      wake_time_(never_) {
  // calloc: pages that nobody writes take no memory.
  bytes_.reset(static_cast<std::uint8_t*>(std::calloc(static_cast<std::size_t>(timing.size.count()), 1)));
  if (bytes_ == nullptr) {
    throw UserError(fmt::format("this computer cannot hold a memory of {} bytes", timing.size.count()));
  }
  socket.register_nb_transport_fw(this, &Memory::nb_transport_fw);
  socket.register_b_transport(this, &Memory::b_transport);
  socket.register_transport_dbg(this, &Memory::transport_dbg);
  SC_HAS_PROCESS(Memory);
  SC_METHOD(run);
  sensitive << wake_;
  dont_initialize();
}

void Memory::Free::operator()(void* memory) const { std::free(memory); }

void Memory::end_of_elaboration() {
  arbiter_.ports.resize(socket.size());
  arbiter_.arrivals.resize(socket.size(), never_);
  if (socket.size() > 0) arbiter_.last_served = socket.size() - 1;  // the first turn is the first port's
}

const MemoryPortStatistics& Memory::statistics(std::size_t port) const {
  serve_until(sc_core::sc_time_stamp(), false);
  return arbiter_.ports[port].statistics;
}

Cycles Memory::bus_taken(std::size_t port) const {
  const Cycles bus = statistics(port).bus;
  if (port != arbiter_.last_served) return bus;
  return bus - std::max(Cycles(0), arbiter_.bus_free - clock_.now());
}

double Memory::usable_bandwidth() const {
  return static_cast<double>(timing_.bytes_per_cycle.count()) * static_cast<double>(timing_.efficiency) /
         100.0 * static_cast<double>(clock_.frequency().count());
}

::tlm::tlm_sync_enum Memory::nb_transport_fw(int id, ::tlm::tlm_generic_payload& payload,
                                             ::tlm::tlm_phase& phase, sc_core::sc_time& delay) {
  const sc_core::sc_time now = sc_core::sc_time_stamp();
  const auto index = static_cast<std::size_t>(id);
  Port& port = arbiter_.ports[index];
  if (phase == ::tlm::END_RESP) {
    port.answering = false;
    port.answered_until = now + delay;
    if (!port.answers.empty()) wake_at(port.answered_until);
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
  if (port.queue.size() >= timing_.queue_depth) serve_until(now, false);
  if (port.queue.size() >= timing_.queue_depth) {
    port.refused = &payload;
    port.refused_arrival = now + delay;
    ++arbiter_.refused;
    wake_in_time();
    return ::tlm::TLM_ACCEPTED;
  }
  enqueue(index, {&payload, now + delay, transfer_time(payload)});
  phase = ::tlm::END_REQ;
  return ::tlm::TLM_UPDATED;
}

void Memory::b_transport(int id, ::tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  sc_core::sc_event done;
  enqueue(static_cast<std::size_t>(id),
          {&payload, sc_core::sc_time_stamp() + delay, transfer_time(payload), &done});
  delay = sc_core::SC_ZERO_TIME;
  sc_core::wait(done);
}

void Memory::enqueue(std::size_t id, const Request& request) {
  std::deque<Request>& queue = arbiter_.ports[id].queue;
  if (queue.empty()) arbiter_.arrivals[id] = request.arrival;
  queue.push_back(request);
  // Whatever is under way is answered before this request can be.
  if (arbiter_.under_way.empty() || arbiter_.refused != 0) wake_in_time();
}

unsigned Memory::transport_dbg(int, ::tlm::tlm_generic_payload& payload) {
  return access(payload) ? payload.get_data_length() : 0;
}

bool Memory::access(::tlm::tlm_generic_payload& payload) const {
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
  std::uint8_t* place = bytes_.get() + payload.get_address();
  if (payload.is_read()) std::memcpy(payload.get_data_ptr(), place, payload.get_data_length());
  if (payload.is_write()) std::memcpy(place, payload.get_data_ptr(), payload.get_data_length());
  payload.set_response_status(::tlm::TLM_OK_RESPONSE);
  return true;
}

Cycles Memory::transfer_time(const ::tlm::tlm_generic_payload& payload) const {
  const std::int64_t bytes = payload.get_data_length();
  const std::int64_t per_cycle = timing_.bytes_per_cycle.count() * timing_.efficiency;
  return Cycles(std::max<std::int64_t>(1, (bytes * 100 + per_cycle - 1) / per_cycle));
}

// Of the requests that wait, or never_.
const sc_core::sc_time& Memory::first_arrival() const {
  return *std::min_element(arbiter_.arrivals.begin(), arbiter_.arrivals.end());
}

// When the bus is free and a request is there; needs one that waits.
Cycles Memory::next_edge() const {
  const sc_core::sc_time& first = first_arrival();
  return first > arbiter_.bus_free_time ? clock_.cycle_at_or_after(first) : arbiter_.bus_free;
}

// The next port, in the arbiter's order, with a request that has arrived by `time`; needs one.
std::size_t Memory::choose(const sc_core::sc_time& time) const {
  const std::vector<sc_core::sc_time>& arrivals = arbiter_.arrivals;
  const bool in_turn = timing_.arbitration == MemoryTiming::Arbitration::kRoundRobin;
  std::size_t id = in_turn ? arbiter_.last_served + 1 : 0;
  for (;; ++id) {
    if (id == arrivals.size()) id = 0;
    if (arrivals[id] <= time) return id;
  }
}

// Gives the bus to all requests whose turn comes before `time`, or then.
void Memory::serve_until(const sc_core::sc_time& time, bool inclusive) const {
  while (first_arrival() <= time) {
    const Cycles edge = next_edge();
    const sc_core::sc_time at = clock_.time_of(edge);
    if (at > time || (at == time && !inclusive)) return;
    serve(choose(at), edge);
  }
}

void Memory::serve(std::size_t id, Cycles edge) const {
  Port& port = arbiter_.ports[id];
  const Request request = port.queue.front();
  port.queue.pop_front();
  access(*request.payload);
  MemoryPortStatistics& statistics = port.statistics;
  ++statistics.requests;
  (request.payload->is_write() ? statistics.written_bytes : statistics.read_bytes) +=
      request.payload->get_data_length();
  statistics.bus += request.transfer;
  arbiter_.last_served = id;
  arbiter_.bus_free = edge + request.transfer;
  arbiter_.bus_free_time = clock_.time_of(arbiter_.bus_free);
  const sc_core::sc_time ready = clock_.time_of(arbiter_.bus_free + timing_.latency);
  arbiter_.under_way.push_back({ready, id, request});
  if (port.refused != nullptr) {
    ::tlm::tlm_generic_payload& taken = *std::exchange(port.refused, nullptr);
    --arbiter_.refused;
    port.queue.push_back({&taken, port.refused_arrival, transfer_time(taken)});
    arbiter_.taken.push_back({id, &taken, port.refused_arrival});
  }
  arbiter_.arrivals[id] = port.queue.empty() ? never_ : port.queue.front().arrival;
}

void Memory::run() {
  const sc_core::sc_time now = sc_core::sc_time_stamp();
  running_ = true;
  wake_time_ = never_;
  serve_until(now, std::exchange(inclusive_, false));
  end_requests();
  while (!arbiter_.under_way.empty() && arbiter_.under_way.front().ready <= now) {
    const Served served = arbiter_.under_way.front();
    arbiter_.under_way.pop_front();
    Port& port = arbiter_.ports[served.port];
    if (port.answers.empty() && may_respond(port)) {
      begin_response(served.port, served.request);
    } else {
      port.answers.push_back(served.request);
      ++held_;
    }
  }
  for (std::size_t id = 0; held_ != 0 && id < arbiter_.ports.size(); ++id) {
    Port& port = arbiter_.ports[id];
    while (!port.answers.empty() && may_respond(port)) {
      const Request request = port.answers.front();
      port.answers.pop_front();
      --held_;
      begin_response(id, request);
    }
  }
  running_ = false;
  wake_in_time();
}

void Memory::end_requests() {
  const sc_core::sc_time& now = sc_core::sc_time_stamp();
  for (const Taken& taken : std::exchange(arbiter_.taken, {})) {
    ::tlm::tlm_phase phase = ::tlm::END_REQ;
    sc_core::sc_time delay = std::max(now, taken.arrival) - now;
    socket[static_cast<int>(taken.port)]->nb_transport_bw(*taken.payload, phase, delay);
  }
}

bool Memory::may_respond(const Port& port) const {
  return !port.answering && port.answered_until <= sc_core::sc_time_stamp();
}

void Memory::begin_response(std::size_t id, const Request& request) {
  Port& port = arbiter_.ports[id];
  const sc_core::sc_time& now = sc_core::sc_time_stamp();
  const sc_core::sc_time latency = now - request.arrival;
  port.statistics.latency_sum += latency;
  port.statistics.latency_largest = std::max(port.statistics.latency_largest, latency);
  if (request.blocking != nullptr) {
    request.blocking->notify();
    return;
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

// Notifies the next event: no later than the next answer is due, and than somebody has to be told that his request
// is taken.
void Memory::wake_in_time() {
  if (running_) return;  // run() ends with this
  const sc_core::sc_time& now = sc_core::sc_time_stamp();
  if (!arbiter_.under_way.empty()) {
    wake_at(arbiter_.under_way.front().ready);
  } else if (first_arrival() != never_) {
    // The answer to whoever would be served next as things are. A request that changes this comes through here.
    const Cycles edge = next_edge();
    const Port& port = arbiter_.ports[choose(clock_.time_of(edge))];
    wake_at(clock_.time_of(edge + port.queue.front().transfer + timing_.latency));
  }
  if (arbiter_.refused != 0) {
    const sc_core::sc_time at = clock_.time_of(next_edge());
    inclusive_ = at <= now;
    wake_at(std::max(at, now));
  }
  for (std::size_t id = 0; held_ != 0 && id < arbiter_.ports.size(); ++id) {
    const Port& port = arbiter_.ports[id];
    if (!port.answers.empty() && !port.answering) wake_at(port.answered_until);
  }
}

void Memory::wake_at(const sc_core::sc_time& time) {
  if (running_ || time >= wake_time_) return;
  wake_time_ = time;
  wake_.notify(time - sc_core::sc_time_stamp());
}

}  // namespace parallax
