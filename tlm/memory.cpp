// SPDX-License-Identifier: Apache-2.0
#include "tlm/memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "tlm/error.hpp"
#include "tlm/traffic_only.hpp"

namespace parallax {
namespace {

Picoseconds date(const sc_core::sc_time& time) { return Picoseconds(time.value()); }

Picoseconds present() { return date(sc_core::sc_time_stamp()); }

sc_core::sc_time time(Picoseconds date) {
  return sc_core::sc_time::from_value(static_cast<std::uint64_t>(date.count()));
}

}  // namespace

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
  SC_METHOD(run);
  sensitive << wake_;
  dont_initialize();
}

void Memory::Free::operator()(void* memory) const { std::free(memory); }

void Memory::end_of_elaboration() {
  arbiter_.ports.resize(socket.size());
  arbiter_.arrivals.resize(socket.size(), kNever);
  if (socket.size() > 0) arbiter_.last_served = socket.size() - 1;  // the first turn is the first port's
}

const MemoryPortStatistics& Memory::statistics(std::size_t port) const {
  serve_until(present(), false);
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
  const Picoseconds now = present();
  const auto index = static_cast<std::size_t>(id);
  Port& port = arbiter_.ports[index];
  if (phase == ::tlm::END_RESP) {
    port.answering = false;
    port.answered_until = now + date(delay);
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
    port.refused_arrival = now + date(delay);
    ++arbiter_.refused;
    wake_in_time();
    return ::tlm::TLM_ACCEPTED;
  }
  enqueue(index, {&payload, now + date(delay), transfer_time(payload)});
  phase = ::tlm::END_REQ;
  return ::tlm::TLM_UPDATED;
}

void Memory::b_transport(int id, ::tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  sc_core::sc_event done;
  enqueue(static_cast<std::size_t>(id),
          {&payload, present() + date(delay), transfer_time(payload), &done});
  delay = sc_core::SC_ZERO_TIME;
  sc_core::wait(done);
}

void Memory::enqueue(std::size_t id, const Request& request) {
  Ring<Request>& queue = arbiter_.ports[id].queue;
  if (queue.empty()) {
    arbiter_.arrivals[id] = request.arrival;
    arbiter_.first_arrival = std::min(arbiter_.first_arrival, request.arrival);
  }
  queue.push_back(request);
  // Whatever is under way is answered before this request can be.
  if (arbiter_.under_way.empty() || arbiter_.refused != 0) wake_in_time();
}

unsigned Memory::transport_dbg(int, ::tlm::tlm_generic_payload& payload) {
  return timing_.holds_data && access(payload) ? payload.get_data_length() : 0;
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
  payload.set_response_status(::tlm::TLM_OK_RESPONSE);
  if (!timing_.holds_data || payload.get_extension<TrafficOnly>() != nullptr) return true;
  std::uint8_t* place = bytes_.get() + payload.get_address();
  if (payload.is_read()) std::memcpy(payload.get_data_ptr(), place, payload.get_data_length());
  if (payload.is_write()) std::memcpy(place, payload.get_data_ptr(), payload.get_data_length());
  return true;
}

Cycles Memory::transfer_time(const ::tlm::tlm_generic_payload& payload) const {
  const std::int64_t bytes = payload.get_data_length();
  const std::int64_t per_cycle = timing_.bytes_per_cycle.count() * timing_.efficiency;
  return Cycles(std::max<std::int64_t>(1, (bytes * 100 + per_cycle - 1) / per_cycle));
}

// When the bus is free and a request is there; needs one that waits.
Cycles Memory::next_edge() const {
  const Picoseconds first = arbiter_.first_arrival;
  return first > arbiter_.bus_free_date ? clock_.cycle_at_or_after(first) : arbiter_.bus_free;
}

// The next port, in the arbiter's order, with a request that has arrived by `date`; needs one.
std::size_t Memory::choose(Picoseconds date) const {
  const std::vector<Picoseconds>& arrivals = arbiter_.arrivals;
  const bool in_turn = timing_.arbitration == MemoryTiming::Arbitration::kRoundRobin;
  std::size_t id = in_turn ? arbiter_.last_served + 1 : 0;
  for (;; ++id) {
    if (id == arrivals.size()) id = 0;
    if (arrivals[id] <= date) return id;
  }
}

// Gives the bus to all requests whose turn comes before `date`, or then.
void Memory::serve_until(Picoseconds date, bool inclusive) const {
  while (arbiter_.first_arrival <= date) {
    const Cycles edge = next_edge();
    const Picoseconds at = clock_.date_of(edge);
    if (at > date || (at == date && !inclusive)) return;
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
  arbiter_.bus_free_date = clock_.date_of(arbiter_.bus_free);
  arbiter_.under_way.push_back({clock_.date_of(arbiter_.bus_free + timing_.latency), id, request});
  if (port.refused != nullptr) {
    ::tlm::tlm_generic_payload& taken = *std::exchange(port.refused, nullptr);
    --arbiter_.refused;
    port.queue.push_back({&taken, port.refused_arrival, transfer_time(taken)});
    arbiter_.taken.push_back({id, &taken, port.refused_arrival});
  }
  arbiter_.arrivals[id] = port.queue.empty() ? kNever : port.queue.front().arrival;
  arbiter_.first_arrival = *std::min_element(arbiter_.arrivals.begin(), arbiter_.arrivals.end());
}

void Memory::run() {
  const Picoseconds now = present();
  running_ = true;
  wake_date_ = kNever;
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
  if (arbiter_.taken.empty()) return;
  const Picoseconds now = present();
  for (const Taken& taken : std::exchange(arbiter_.taken, {})) {
    ::tlm::tlm_phase phase = ::tlm::END_REQ;
    sc_core::sc_time delay = time(std::max(now, taken.arrival) - now);
    socket[static_cast<int>(taken.port)]->nb_transport_bw(*taken.payload, phase, delay);
  }
}

bool Memory::may_respond(const Port& port) const {
  return !port.answering && port.answered_until <= present();
}

void Memory::begin_response(std::size_t id, const Request& request) {
  Port& port = arbiter_.ports[id];
  const Picoseconds now = present();
  const sc_core::sc_time latency = time(now - request.arrival);
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
  if (!port.answering) port.answered_until = now + date(delay);
  request.payload->release();
}

// Notifies the next event: no later than the next answer is due, and than somebody has to be told that his request
// is taken.
void Memory::wake_in_time() {
  if (running_) return;  // run() ends with this
  if (!arbiter_.under_way.empty()) {
    wake_at(arbiter_.under_way.front().ready);
  } else if (arbiter_.first_arrival != kNever) {
    // The answer to whoever would be served next as things are. A request that changes this comes through here.
    const Cycles edge = next_edge();
    const Port& port = arbiter_.ports[choose(clock_.date_of(edge))];
    wake_at(clock_.date_of(edge + port.queue.front().transfer + timing_.latency));
  }
  if (arbiter_.refused != 0) {
    const Picoseconds now = present();
    const Picoseconds at = clock_.date_of(next_edge());
    inclusive_ = at <= now;
    wake_at(std::max(at, now));
  }
  for (std::size_t id = 0; held_ != 0 && id < arbiter_.ports.size(); ++id) {
    const Port& port = arbiter_.ports[id];
    if (!port.answers.empty() && !port.answering) wake_at(port.answered_until);
  }
}

void Memory::wake_at(Picoseconds date) {
  if (running_ || date >= wake_date_) return;
  wake_date_ = date;
  wake_.notify(time(date - present()));
}

}  // namespace parallax
