// SPDX-License-Identifier: Apache-2.0
// Blocks and memories of a user's that stop without a word.
#pragma once

#include <tlm_utils/simple_target_socket.h>

#include <cstdint>
#include <memory>
#include <string>
#include <systemc>
#include <utility>
#include <vector>

#include "platform/machine/stage_slot.hpp"
#include "tlm/stream.hpp"

namespace parallax::test {

/// In the place of the census stage, clocked: takes a token of both images in each cycle, and writes as many.
class ClockedHalf final : public sc_core::sc_module {
 public:
  /// Reads so many tokens, and writes so many of them; then its clock goes on, and it does nothing.
  struct Work {
    std::uint64_t reads = 0;
    std::uint64_t writes = 0;
  };
  StreamIn<Gray> in_left{"in_left"};
  StreamIn<Gray> in_right{"in_right"};
  StreamOut<CensusCode> out_left{"out_left"};
  StreamOut<CensusCode> out_right{"out_right"};

  ClockedHalf(const sc_core::sc_module_name& name, const ClockDomain& clock, Work work)
      : sc_module(name), edge_("edge", clock.time_of(Cycles(1))), work_(work) {
    SC_HAS_PROCESS(ClockedHalf);
    SC_METHOD(step);
    sensitive << edge_.posedge_event();
  }

 private:
  void step() {
    if (written_ < work_.writes && written_ < read_ && out_left[0]->can_write() &&
        out_right[0]->can_write()) {
      for (auto* out : {&out_left, &out_right}) (*out)[0]->commit();
      ++written_;
    }
    if (read_ == work_.reads || !in_left->can_read() || !in_right->can_read()) return;
    in_left->release();
    in_right->release();
    ++read_;
  }

  sc_core::sc_clock edge_;
  const Work work_;
  std::uint64_t read_ = 0, written_ = 0;
};

/// The same from a thread that waits for tokens and for room, and ends.
class ThreadHalf final : public sc_core::sc_module {
 public:
  StreamIn<Gray> in_left{"in_left"};
  StreamIn<Gray> in_right{"in_right"};
  StreamOut<CensusCode> out_left{"out_left"};
  StreamOut<CensusCode> out_right{"out_right"};

  ThreadHalf(const sc_core::sc_module_name& name, std::uint64_t tokens) : sc_module(name), tokens_(tokens) {
    SC_HAS_PROCESS(ThreadHalf);
    SC_THREAD(run);
  }

 private:
  void run() {
    for (std::uint64_t i = 0; i < tokens_; ++i) {
      in_left->wait_readable();
      in_left->release();
      in_right->wait_readable();
      in_right->release();
      for (auto* out : {&out_left, &out_right}) {
        (*out)[0]->wait_writable();
        (*out)[0]->commit();
      }
    }
  }
  const std::uint64_t tokens_;
};

/// A memory for timing alone, at each port of which the first requests are answered in their order, 100 ns
/// after they came, and then one is not as it should be.
class OddMemory final : public sc_core::sc_module {
 public:
  enum class Odd { kTakesNone, kAnswersNone, kAnswersTwice, kAnswersBackwards };

  OddMemory(const sc_core::sc_module_name& name, Odd odd, std::string port, std::uint64_t good)
      : sc_module(name), odd_(odd), port_(std::move(port)), good_(good) {}

  void bind(::tlm::tlm_initiator_socket<>& socket, const std::string& port) {
    ports_.push_back(
        std::make_unique<Port>(("at_" + port).c_str(), port == port_ ? good_ : ~std::uint64_t{0}, odd_));
    socket.bind(ports_.back()->socket);
  }

 private:
  struct Port final : public sc_core::sc_module {
    tlm_utils::simple_target_socket<Port> socket{"socket"};

    Port(const sc_core::sc_module_name& name, std::uint64_t good, Odd odd)
        : sc_module(name), good_(good), odd_(odd) {
      socket.register_nb_transport_fw(this, &Port::request);
      SC_HAS_PROCESS(Port);
      SC_METHOD(answer);
      sensitive << due_;
      dont_initialize();
    }

   private:
    ::tlm::tlm_sync_enum request(::tlm::tlm_generic_payload& payload, ::tlm::tlm_phase& phase,
                                 sc_core::sc_time&) {
      if (phase != ::tlm::BEGIN_REQ) return ::tlm::TLM_COMPLETED;
      const bool good = number_++ < good_;
      if (!good && odd_ == Odd::kTakesNone) return ::tlm::TLM_ACCEPTED;
      payload.acquire();
      payload.set_response_status(::tlm::TLM_OK_RESPONSE);
      if (good) {
        waiting_.push_back(&payload);
      } else if (odd_ == Odd::kAnswersTwice) {
        waiting_.insert(waiting_.end(), 2, &payload);
      } else if (odd_ == Odd::kAnswersBackwards) {
        backwards_.push_back(&payload);
        if (backwards_.size() == 2) waiting_.insert(waiting_.end(), backwards_.rbegin(), backwards_.rend());
      }
      due_.notify(sc_core::sc_time(100, sc_core::SC_NS));
      phase = ::tlm::END_REQ;
      return ::tlm::TLM_UPDATED;
    }
    void answer() {
      const std::vector<::tlm::tlm_generic_payload*> all = std::exchange(waiting_, {});
      for (::tlm::tlm_generic_payload* payload : all) {
        ::tlm::tlm_phase phase = ::tlm::BEGIN_RESP;
        sc_core::sc_time delay;
        socket->nb_transport_bw(*payload, phase, delay);
      }
    }

    const std::uint64_t good_;
    const Odd odd_;
    std::uint64_t number_ = 0;
    std::vector<::tlm::tlm_generic_payload*> waiting_, backwards_;
    sc_core::sc_event due_;
  };

  const Odd odd_;
  const std::string port_;
  const std::uint64_t good_;
  std::vector<std::unique_ptr<Port>> ports_;
};

}  // namespace parallax::test
