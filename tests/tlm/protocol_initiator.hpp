// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <tlm_utils/simple_initiator_socket.h>

#include <map>
#include <string>
#include <systemc>
#include <tlm>
#include <vector>

#include "tlm/payload_pool.hpp"

namespace parallax::test {

/// An initiator that sends what it is told, notes when each phase happened, and checks the order of phases of
/// the base protocol: BEGIN_REQ, END_REQ, BEGIN_RESP, END_RESP of each transaction, one request and one
/// response at a time.
class ProtocolInitiator final : public sc_core::sc_module {
 public:
  /// How it answers BEGIN_RESP.
  enum class Answer { kCompleted, kUpdated, kLater };
  struct Times {
    sc_core::sc_time begin_request, end_request, begin_response;
    sc_core::sc_time told;  ///< when BEGIN_RESP was called, its date perhaps in the future
    ::tlm::tlm_response_status status = ::tlm::TLM_INCOMPLETE_RESPONSE;
    std::vector<std::uint8_t> data;
  };

  tlm_utils::simple_initiator_socket<ProtocolInitiator> socket{"socket"};
  Answer answer = Answer::kCompleted;
  sc_core::sc_time answer_delay;       ///< from BEGIN_RESP to END_RESP
  std::vector<Times> times;            ///< in the order of sending
  std::vector<std::size_t> responses;  ///< indices into times, in the order of arrival

  explicit ProtocolInitiator(const sc_core::sc_module_name& name) : sc_module(name) {
    socket.register_nb_transport_bw(this, &ProtocolInitiator::backward);
    SC_HAS_PROCESS(ProtocolInitiator);
    SC_METHOD(end_response);
    sensitive << end_response_;
    dont_initialize();
  }

  /// For a thread: BEGIN_REQ, `delay` annotated; returns when the request has ended.
  void send(::tlm::tlm_command command, std::uint64_t address, std::size_t length,
            const sc_core::sc_time& delay = sc_core::SC_ZERO_TIME) {
    ::tlm::tlm_generic_payload& payload = pool_.take(command, address, length);
    for (std::size_t i = 0; i < length; ++i)
      payload.get_data_ptr()[i] = static_cast<std::uint8_t>(address + i);
    send(payload, delay);
  }
  void send(::tlm::tlm_generic_payload& payload, sc_core::sc_time delay = sc_core::SC_ZERO_TIME) {
    EXPECT_EQ(requesting_, nullptr);
    index_[&payload] = times.size();
    times.emplace_back();
    times.back().begin_request = sc_core::sc_time_stamp() + delay;
    requesting_ = &payload;
    ::tlm::tlm_phase phase = ::tlm::BEGIN_REQ;
    const ::tlm::tlm_sync_enum status = socket->nb_transport_fw(payload, phase, delay);
    if (status == ::tlm::TLM_UPDATED) {
      EXPECT_EQ(phase, ::tlm::END_REQ);
      request_ended(payload, delay);
    } else {
      EXPECT_EQ(status, ::tlm::TLM_ACCEPTED);
    }
    while (requesting_ != nullptr) sc_core::wait(moved_);
  }
  ::tlm::tlm_generic_payload& take(::tlm::tlm_command command, std::uint64_t address, std::size_t length) {
    return pool_.take(command, address, length);
  }
  /// For a thread: returns when everything sent is answered, at the date of the last answer if that was given
  /// ahead.
  void wait_for_all() {
    while (responses.size() < times.size() || responding_ != nullptr) sc_core::wait(moved_);
    const sc_core::sc_time now = sc_core::sc_time_stamp();
    if (latest_response_ > now) sc_core::wait(latest_response_ - now);
  }

 private:
  void request_ended(::tlm::tlm_generic_payload& payload, const sc_core::sc_time& delay) {
    EXPECT_EQ(requesting_, &payload) << "END_REQ of a request that is not open";
    requesting_ = nullptr;
    Times& t = times[index_[&payload]];
    t.end_request = sc_core::sc_time_stamp() + delay;
    EXPECT_GE(t.end_request, t.begin_request);
    moved_.notify(delay);
  }

  ::tlm::tlm_sync_enum backward(::tlm::tlm_generic_payload& payload, ::tlm::tlm_phase& phase,
                                sc_core::sc_time& delay) {
    EXPECT_EQ(index_.count(&payload), 1u) << "a phase of a transaction that is over";
    if (phase == ::tlm::END_REQ) {
      request_ended(payload, delay);
      return ::tlm::TLM_ACCEPTED;
    }
    EXPECT_EQ(phase, ::tlm::BEGIN_RESP);
    EXPECT_NE(requesting_, &payload) << "BEGIN_RESP before END_REQ";
    EXPECT_EQ(responding_, nullptr) << "BEGIN_RESP before the END_RESP of another one";
    const sc_core::sc_time now = sc_core::sc_time_stamp() + delay;
    EXPECT_GE(now, free_from_) << "BEGIN_RESP before the END_RESP of another one";
    Times& t = times[index_[&payload]];
    EXPECT_GE(now, t.end_request);
    t.begin_response = now;
    t.told = sc_core::sc_time_stamp();
    latest_response_ = now;
    t.status = payload.get_response_status();
    t.data.assign(payload.get_data_ptr(), payload.get_data_ptr() + payload.get_data_length());
    responses.push_back(index_[&payload]);
    index_.erase(&payload);
    free_from_ = now + answer_delay;
    switch (answer) {
      case Answer::kCompleted:
        delay += answer_delay;
        break;
      case Answer::kUpdated:
        phase = ::tlm::END_RESP;
        delay += answer_delay;
        break;
      case Answer::kLater:
        responding_ = &payload;
        end_response_.notify(delay + answer_delay);
        return ::tlm::TLM_ACCEPTED;
    }
    payload.release();
    moved_.notify(sc_core::SC_ZERO_TIME);
    return answer == Answer::kUpdated ? ::tlm::TLM_UPDATED : ::tlm::TLM_COMPLETED;
  }

  void end_response() {
    ::tlm::tlm_generic_payload& payload = *responding_;
    responding_ = nullptr;
    ::tlm::tlm_phase phase = ::tlm::END_RESP;
    sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
    socket->nb_transport_fw(payload, phase, delay);
    payload.release();
    moved_.notify(sc_core::SC_ZERO_TIME);
  }

  PayloadPool pool_{4096};
  std::map<::tlm::tlm_generic_payload*, std::size_t> index_;
  ::tlm::tlm_generic_payload* requesting_ = nullptr;
  ::tlm::tlm_generic_payload* responding_ = nullptr;
  sc_core::sc_time free_from_;
  sc_core::sc_time latest_response_;
  sc_core::sc_event moved_;
  sc_core::sc_event end_response_;
};

}  // namespace parallax::test
