// SPDX-License-Identifier: Apache-2.0
#include "tlm/memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "tlm/error.hpp"
#include "tlm/time_resolution.hpp"
#include "tlm/traffic_only.hpp"

namespace parallax {
namespace {

Picoseconds date(const sc_core::sc_time& time) { return Picoseconds(time.value()); }

Picoseconds present() { return date(sc_core::sc_time_stamp()); }

sc_core::sc_time time(Picoseconds date) { return sc_core::sc_time::from_value(date.size()); }

}  // namespace

Memory::Memory(const sc_core::sc_module_name& name, const MemoryTargetConfig& config,
               std::unique_ptr<MemoryScheduler> scheduler)
    : sc_module(name), config_(config), scheduler_(std::move(scheduler)), queues_(config.queue_depth) {
  require_picosecond_resolution();
  if (scheduler_ == nullptr) throw std::invalid_argument("a memory needs a scheduler");
  if (config.queue_depth < 1) throw UserError("memory.queue_depth = 0: must be at least 1");
  if (config.holds_data) {
    // calloc: pages that are not written take no memory.
    bytes_.reset(static_cast<std::uint8_t*>(std::calloc(config.size.size(), 1)));
    if (bytes_ == nullptr) {
      throw UserError(fmt::format("this computer cannot hold a memory of {} bytes", config.size.count()));
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
  ports_.resize(socket.size());
  queues_.set_ports(socket.size());
  scheduler_->bind(queues_);
}

// Decisions are the same whenever they are made; asking for one is no change.
void Memory::serve_until(Picoseconds date, bool inclusive) const {
  scheduler_->serve_until(date, inclusive, const_cast<Memory&>(*this));
}

const MemoryPortStatistics& Memory::statistics(std::size_t port) const {
  const Picoseconds now = present();
  serve_until(now, false);
  count_answers(ports_[port], now);
  return ports_[port].statistics;
}

Cycles Memory::bus_taken(std::size_t port) const {
  serve_until(present(), false);
  return scheduler_->bus_taken(port, present());
}

Cycles Memory::at_work() const {
  serve_until(present(), false);
  return scheduler_->at_work(present());
}

const DramStatistics* Memory::commands() const {
  serve_until(present(), false);
  return scheduler_->commands();
}

Cycles Memory::cycle_at_or_after(const sc_core::sc_time& time) const {
  return scheduler_->cycle_at_or_after(date(time));
}

::tlm::tlm_sync_enum Memory::nb_transport_fw(int id, ::tlm::tlm_generic_payload& payload,
                                             ::tlm::tlm_phase& phase, sc_core::sc_time& delay) {
  const Picoseconds now = present();
  const std::size_t index = id;
  AnswerPort& port = ports_[index];
  if (phase == ::tlm::END_RESP) {
    if (!port.answering || port.answered_payload != &payload) {
      SC_REPORT_ERROR("/parallax/memory/phase", "an END_RESP without a BEGIN_RESP of that request before it");
      return ::tlm::TLM_COMPLETED;
    }
    port.answering = false;
    port.answered_until = now + date(delay);
    if (!port.held.empty()) wake_at(std::max(port.answered_until, port.held.front().ready));
    return ::tlm::TLM_COMPLETED;
  }
  if (phase != ::tlm::BEGIN_REQ) {
    SC_REPORT_ERROR("/parallax/memory/phase", "a request must begin with BEGIN_REQ and end with END_RESP");
    return ::tlm::TLM_COMPLETED;
  }
  if (queues_.has_refused(index)) {
    SC_REPORT_ERROR("/parallax/memory/phase", "a second BEGIN_REQ before the END_REQ of the first");
    return ::tlm::TLM_COMPLETED;
  }
  if (!payload.has_mm()) {
    SC_REPORT_ERROR("/parallax/memory/payload", "nb_transport needs a payload with a memory manager");
    return ::tlm::TLM_COMPLETED;
  }
  payload.acquire();
  const MemoryRequest request{&payload, now + date(delay)};
  if (!queues_.room(index)) serve_until(now, false);
  if (!queues_.room(index)) {
    queues_.refuse(index, request);
    wake_in_time();
    return ::tlm::TLM_ACCEPTED;
  }
  enqueue(index, request);
  phase = ::tlm::END_REQ;
  return ::tlm::TLM_UPDATED;
}

void Memory::b_transport(int id, ::tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  sc_core::sc_event done;
  enqueue(id, {&payload, present() + date(delay), &done});
  delay = sc_core::SC_ZERO_TIME;
  sc_core::wait(done);
}

void Memory::enqueue(std::size_t id, const MemoryRequest& request) {
  const bool first = queues_.push(id, request);
  // Its answer comes after those before it in the queue, and after its arrival.
  if (first && request.arrival < wake_date_) wake_in_time();
}

unsigned Memory::transport_dbg(int, ::tlm::tlm_generic_payload& payload) {
  return config_.holds_data && access(payload) ? payload.get_data_length() : 0;
}

bool Memory::access(::tlm::tlm_generic_payload& payload) const {
  const auto size = config_.size.size();
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
  const bool traffic_only = !config_.holds_data || payload.get_extension<TrafficOnly>() != nullptr;
  if (!traffic_only && payload.get_data_ptr() == nullptr && payload.get_data_length() > 0) {
    payload.set_response_status(::tlm::TLM_GENERIC_ERROR_RESPONSE);
    return false;
  }
  payload.set_response_status(::tlm::TLM_OK_RESPONSE);
  if (traffic_only) return true;
  std::uint8_t* bytes = bytes_.get() + payload.get_address();
  if (payload.is_read()) std::memcpy(payload.get_data_ptr(), bytes, payload.get_data_length());
  if (payload.is_write()) std::memcpy(bytes, payload.get_data_ptr(), payload.get_data_length());
  return true;
}

void Memory::served(std::size_t port, const MemoryRequest& request) {
  const bool ok = access(*request.payload);
  MemoryPortStatistics& statistics = ports_[port].statistics;
  ++statistics.requests;
  if (!ok) return;
  if (request.payload->is_write()) statistics.written_bytes += request.payload->get_data_length();
  if (request.payload->is_read()) statistics.read_bytes += request.payload->get_data_length();
}

void Memory::run() {
  const Picoseconds now = present();
  running_ = true;
  wake_date_ = kNever;
  serve_until(now, std::exchange(inclusive_, false));
  end_requests(now);
  while (!answers_.empty()) {
    // A copy, as new ones may come meanwhile; field by field, as it has just been written so.
    const Answer& first = answers_.front();
    const Answer answer{
        {first.request.payload, first.request.arrival, first.request.blocking}, first.ready, first.port};
    answers_.pop_front();
    AnswerPort& port = ports_[answer.port];
    if (port.answering || !port.held.empty()) {
      port.held.push_back(answer);
      ++held_;
    } else {
      begin_response(answer, now);
    }
  }
  for (std::size_t id = 0; held_ != 0 && id < ports_.size(); ++id) {
    AnswerPort& port = ports_[id];
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
  if (!queues_.any_newly_taken()) return;
  for (const MemoryQueues::Taken& taken : queues_.newly_taken()) {
    ::tlm::tlm_phase phase = ::tlm::END_REQ;
    sc_core::sc_time delay = time(std::max({now, taken.date, taken.request.arrival}) - now);
    socket[static_cast<int>(taken.port)]->nb_transport_bw(*taken.request.payload, phase, delay);
  }
}

void Memory::begin_response(const Answer& answer, Picoseconds now) {
  AnswerPort& port = ports_[answer.port];
  const Picoseconds at = std::max({now, answer.ready, port.answered_until});
  count_answers(port, now);
  EarlyAnswer& early = port.early.add();
  early.date = at;
  early.latency = at - answer.request.arrival;
  sc_core::sc_time delay = time(at - now);
  if (answer.request.blocking != nullptr) {
    answer.request.blocking->notify(delay);
    return;
  }
  ::tlm::tlm_phase phase = ::tlm::BEGIN_RESP;
  port.answering = true;  // until the END_RESP, which may come within the call
  port.answered_payload = answer.request.payload;
  const ::tlm::tlm_sync_enum status =
      socket[static_cast<int>(answer.port)]->nb_transport_bw(*answer.request.payload, phase, delay);
  if (status == ::tlm::TLM_COMPLETED || (status == ::tlm::TLM_UPDATED && phase == ::tlm::END_RESP)) {
    port.answering = false;
    port.answered_until = now + date(delay);
  }
  answer.request.payload->release();
}

// Counts the answers that were given ahead of their dates and are there now.
void Memory::count_answers(AnswerPort& port, Picoseconds now) const {
  for (; !port.early.empty() && port.early.front().date <= now; port.early.pop_front()) {
    const sc_core::sc_time latency = time(port.early.front().latency);
    port.statistics.latency_sum += latency;
    port.statistics.latency_largest = std::max(port.statistics.latency_largest, latency);
  }
}

// Notifies the next event: no later than the next answer is due, and than somebody has to be told that his
// request is taken.
void Memory::wake_in_time() {
  if (running_) return;  // run() ends with this
  if (const Picoseconds answer = scheduler_->next_answer(); answer != kNever) {
    wake_at(std::max(answer, present()));
  }
  if (queues_.any_refused()) {
    const Picoseconds now = present();
    const Picoseconds slot = scheduler_->next_slot();
    inclusive_ = slot <= now;
    wake_at(std::max(slot, now));
  }
}

void Memory::wake_at(Picoseconds date) {
  if (running_ || date >= wake_date_) return;
  wake_date_ = date;
  wake_.notify(time(date - present()));
}

}  // namespace parallax
