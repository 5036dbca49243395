// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tlm_utils/simple_target_socket.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <random>
#include <systemc>
#include <tlm>
#include <vector>

namespace parallax::test {

/// Another memory, as a user might bring one: answers in order after random times, in every way that the base
/// protocol allows: END_REQ at once, later, dated ahead, or left out; BEGIN_RESP on time or dated ahead; the
/// whole transaction in one call. With an even seed it is sloppy and does not look at the delay of a request.
class RandomMemory final : public sc_core::sc_module {
 public:
  tlm_utils::simple_target_socket<RandomMemory> socket{"socket"};
  std::vector<std::uint8_t> bytes;
  std::vector<sc_core::sc_time> requests;  ///< when each BEGIN_REQ came
  std::size_t most_in_flight = 0;

  /// `slowest`: longest time of each step, in ns.
  RandomMemory(const sc_core::sc_module_name& name, std::size_t size, std::uint32_t seed, int slowest)
      : sc_module(name), bytes(size), random_(seed), slowest_(slowest), sloppy_(seed % 2 == 0) {
    socket.register_nb_transport_fw(this, &RandomMemory::forward);
    socket.register_transport_dbg(this, &RandomMemory::debug);
    SC_HAS_PROCESS(RandomMemory);
    SC_THREAD(run);
  }

 private:
  struct Event {
    sc_core::sc_time time;
    ::tlm::tlm_generic_payload* payload;
    ::tlm::tlm_phase phase;
  };

  sc_core::sc_time some_time() {
    return sc_core::sc_time(static_cast<double>(random_() % static_cast<unsigned>(slowest_ + 1)),
                            sc_core::SC_NS);
  }

  ::tlm::tlm_sync_enum forward(::tlm::tlm_generic_payload& payload, ::tlm::tlm_phase& phase,
                               sc_core::sc_time& delay) {
    if (phase == ::tlm::END_RESP) {
      responding_ = false;
      moved_.notify(sc_core::SC_ZERO_TIME);
      return ::tlm::TLM_COMPLETED;
    }
    requests.push_back(sc_core::sc_time_stamp() + delay);
    const sc_core::sc_time arrival = sloppy_ ? sc_core::sc_time_stamp() : requests.back();
    access(payload);
    if (in_flight_ == 0 && random_() % 8 == 0) {
      most_in_flight = std::max<std::size_t>(most_in_flight, 1);
      delay += some_time();
      return ::tlm::TLM_COMPLETED;
    }
    payload.acquire();
    most_in_flight = std::max(most_in_flight, ++in_flight_);
    sc_core::sc_time time = std::max(last_, arrival + some_time());
    const auto way = random_() % 3;
    if (way == 1) events_.push_back({time, &payload, ::tlm::END_REQ});
    last_ = time + some_time();
    events_.push_back({last_, &payload, ::tlm::BEGIN_RESP});
    moved_.notify(sc_core::SC_ZERO_TIME);
    if (way != 0) return ::tlm::TLM_ACCEPTED;
    phase = ::tlm::END_REQ;
    delay += some_time();
    // The answer is no earlier than the end of the request.
    last_ = std::max(last_, sc_core::sc_time_stamp() + delay);
    events_.back().time = last_;
    return ::tlm::TLM_UPDATED;
  }

  void run() {
    for (;;) {
      while (events_.empty() || responding_) sc_core::wait(moved_);
      const Event event = events_.front();
      const sc_core::sc_time now = sc_core::sc_time_stamp();
      // Some are called early, with their time as a delay.
      const sc_core::sc_time call = random_() % 3 == 0 && event.phase == ::tlm::BEGIN_RESP
                                        ? std::max(now, event.time - ahead(event.time))
                                        : event.time;
      if (call > now) sc_core::wait(call - now);
      events_.pop_front();
      ::tlm::tlm_phase phase = event.phase;
      sc_core::sc_time delay = std::max(event.time, sc_core::sc_time_stamp()) - sc_core::sc_time_stamp();
      if (phase == ::tlm::BEGIN_RESP) {
        --in_flight_;
        responding_ = true;
      }
      const ::tlm::tlm_sync_enum status = socket->nb_transport_bw(*event.payload, phase, delay);
      if (event.phase == ::tlm::BEGIN_RESP) {
        if (status != ::tlm::TLM_ACCEPTED) responding_ = false;
        event.payload->release();
      }
    }
  }
  static sc_core::sc_time ahead(const sc_core::sc_time& time) {
    return std::min(time, sc_core::sc_time(3, sc_core::SC_NS));
  }

  unsigned debug(::tlm::tlm_generic_payload& payload) {
    access(payload);
    return payload.get_data_length();
  }
  void access(::tlm::tlm_generic_payload& payload) {
    std::uint8_t* stored = bytes.data() + payload.get_address();
    if (payload.is_read()) std::memcpy(payload.get_data_ptr(), stored, payload.get_data_length());
    if (payload.is_write()) std::memcpy(stored, payload.get_data_ptr(), payload.get_data_length());
    payload.set_response_status(::tlm::TLM_OK_RESPONSE);
  }

  std::mt19937 random_;
  int slowest_;
  bool sloppy_;
  std::deque<Event> events_;
  std::size_t in_flight_ = 0;
  bool responding_ = false;
  sc_core::sc_time last_;
  sc_core::sc_event moved_;
};

}  // namespace parallax::test
