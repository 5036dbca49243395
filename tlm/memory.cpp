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
  const Picoseconds now = present();
  serve_until(now, false);
  count_answers(arbiter_.ports[port], now);
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
    if (!port.held.empty()) wake_at(std::max(port.answered_until, port.held.front().ready));
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
    port.refused_transfer = transfer_time(payload);
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
  // Its answer comes after those before it in the queue, and after its arrival.
  if (queue.size() == 1 && request.arrival < wake_date_) wake_in_time();
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

Cycles Memory::transfer_time(const ::tlm::tlm_generic_payload& payload) {
  const std::int64_t bytes = payload.get_data_length();
  if (bytes == 0) return Cycles(1);  // not allowed, but even this is over some time after its arrival
  const std::int64_t per_cycle = timing_.bytes_per_cycle.count() * timing_.efficiency;
  if (bytes != last_length_) last_transfer_ = Cycles((bytes * 100 + per_cycle - 1) / per_cycle);
  last_length_ = bytes;
  return last_transfer_;
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
  arbiter_.answers.push_back({request, clock_.date_of(arbiter_.bus_free + timing_.latency), id});
  if (port.refused != nullptr) {
    ::tlm::tlm_generic_payload& taken = *std::exchange(port.refused, nullptr);
    --arbiter_.refused;
    port.queue.push_back({&taken, port.refused_arrival, port.refused_transfer});
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
  end_requests(now);
  while (!arbiter_.answers.empty()) {
    const Answer answer = arbiter_.answers.front();
    arbiter_.answers.pop_front();
    Port& port = arbiter_.ports[answer.port];
    if (port.answering || !port.held.empty()) {
      port.held.push_back(answer);
      ++held_;
    } else {
      begin_response(answer, now);
    }
  }
  for (std::size_t id = 0; held_ != 0 && id < arbiter_.ports.size(); ++id) {
    Port& port = arbiter_.ports[id];
    while (!port.held.empty() && !port.answering) {
      const Answer answer = port.held.front();
      port.held.pop_front();
      --held_;
      begin_response(answer, now);
    }
  }
  running_ = false;
  wake_in_time();
}

void Memory::end_requests(Picoseconds now) {
  if (arbiter_.taken.empty()) return;
  for (const Taken& taken : std::exchange(arbiter_.taken, {})) {
    ::tlm::tlm_phase phase = ::tlm::END_REQ;
    sc_core::sc_time delay = time(std::max(now, taken.arrival) - now);
    socket[static_cast<int>(taken.port)]->nb_transport_bw(*taken.payload, phase, delay);
  }
}

void Memory::begin_response(const Answer& answer, Picoseconds now) {
  Port& port = arbiter_.ports[answer.port];
  const Picoseconds at = std::max({now, answer.ready, port.answered_until});
  count_answers(port, now);
  port.told.push_back({at, at - answer.request.arrival});
  sc_core::sc_time delay = time(at - now);
  if (answer.request.blocking != nullptr) {
    answer.request.blocking->notify(delay);
    return;
  }
  ::tlm::tlm_phase phase = ::tlm::BEGIN_RESP;
  const ::tlm::tlm_sync_enum status =
      socket[static_cast<int>(answer.port)]->nb_transport_bw(*answer.request.payload, phase, delay);
  port.answering =
      status == ::tlm::TLM_ACCEPTED || (status == ::tlm::TLM_UPDATED && phase != ::tlm::END_RESP);
  if (!port.answering) port.answered_until = now + date(delay);
  answer.request.payload->release();
}

// Counts the answers that were told ahead of their dates and are there now.
void Memory::count_answers(Port& port, Picoseconds now) const {
  for (; !port.told.empty() && port.told.front().date <= now; port.told.pop_front()) {
    const sc_core::sc_time latency = time(port.told.front().latency);
    port.statistics.latency_sum += latency;
    port.statistics.latency_largest = std::max(port.statistics.latency_largest, latency);
  }
}

// Notifies the next event: no later than the next answer is due, and than somebody has to be told that his request
// is taken.
void Memory::wake_in_time() {
  if (running_ || arbiter_.first_arrival == kNever) return;  // run() ends with this
  // The answer to whoever would be served next as things are. A request that changes this comes through here.
  const Cycles edge = next_edge();
  const Picoseconds at = clock_.date_of(edge);
  const Port& port = arbiter_.ports[choose(at)];
  wake_at(clock_.date_of(edge + port.queue.front().transfer + timing_.latency));
  if (arbiter_.refused != 0) {
    const Picoseconds now = present();
    inclusive_ = at <= now;
    wake_at(std::max(at, now));
  }
}

void Memory::wake_at(Picoseconds date) {
  if (running_ || date >= wake_date_) return;
  wake_date_ = date;
  wake_.notify(time(date - present()));
}

}  // namespace parallax
