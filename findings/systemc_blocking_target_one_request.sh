#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A target of SystemC 2.3.4 (Debian's libsystemc 2.3.4-2) that has b_transport only, behind tlm_utils::simple_target_socket,
# never ends a request: the socket turns each BEGIN_REQ into a blocking call, of which it runs as many at once as come, but
# sends no END_REQ, only BEGIN_RESP when the call has returned. The base protocol forbids an initiator a second BEGIN_REQ until
# the first has ended, so one that keeps it has one request under way, whatever its credits: eight reads of 20 ns take 160 ns.
# From eight threads that call b_transport, or against a target that ends each request at once, they take 20 ns.
# Guessed before: END_REQ at the request's date, and the calls one after the other.
set -euo pipefail

version=2.3.4-2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get -o APT::Sandbox::User=root download "libsystemc=$version" "libsystemc-dev=$version" >/dev/null
for package in *.deb; do dpkg-deb -x "$package" .; done
library=$(dirname "$(find "$folder" -name 'libsystemc-*.so' | head -1)")

cat >model.cpp <<'CPP'
#define SC_INCLUDE_DYNAMIC_PROCESSES
#include <tlm_utils/peq_with_cb_and_phase.h>
#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include <cstdio>
#include <cstring>
#include <systemc>
#include <tlm>

using Payload = tlm::tlm_generic_payload;
using Phase = tlm::tlm_phase;
using sc_core::sc_time;

const sc_time kRead(20, sc_core::SC_NS);
constexpr int kReads = 8;

struct Blocking : sc_core::sc_module {
  tlm_utils::simple_target_socket<Blocking> socket{"socket"};
  explicit Blocking(sc_core::sc_module_name name) : sc_module(name) {
    socket.register_b_transport(this, &Blocking::transport);
  }
  void transport(Payload& payload, sc_time& delay) {
    wait(delay + kRead);
    delay = sc_core::SC_ZERO_TIME;
    payload.set_response_status(tlm::TLM_OK_RESPONSE);
  }
};

struct Phased : sc_core::sc_module {  // ends each request at once
  tlm_utils::simple_target_socket<Phased> socket{"socket"};
  tlm_utils::peq_with_cb_and_phase<Phased> later{this, &Phased::answer};
  explicit Phased(sc_core::sc_module_name name) : sc_module(name) {
    socket.register_nb_transport_fw(this, &Phased::transport);
  }
  tlm::tlm_sync_enum transport(Payload& payload, Phase& phase, sc_time& delay) {
    later.notify(payload, tlm::BEGIN_RESP, delay + kRead);
    phase = tlm::END_REQ;
    return tlm::TLM_UPDATED;
  }
  void answer(Payload& payload, const Phase&) {
    Phase phase = tlm::BEGIN_RESP;
    sc_time delay;
    payload.set_response_status(tlm::TLM_OK_RESPONSE);
    socket->nb_transport_bw(payload, phase, delay);
  }
};

struct Manager : tlm::tlm_mm_interface {
  void free(Payload*) override {}
};

// Keeps the request exclusion rule: the next BEGIN_REQ when the one before has ended, by END_REQ or by its answer.
struct Initiator : sc_core::sc_module {
  tlm_utils::simple_initiator_socket<Initiator> socket{"socket"};
  Manager manager;
  Payload payloads[kReads];
  sc_core::sc_event ended;
  Payload* requesting = nullptr;
  int ends = 0, answers = 0;
  bool threads;
  SC_HAS_PROCESS(Initiator);
  Initiator(sc_core::sc_module_name name, bool with_threads) : sc_module(name), threads(with_threads) {
    socket.register_nb_transport_bw(this, &Initiator::answered);
    SC_THREAD(run);
  }
  void run() {
    for (Payload& payload : payloads) {
      payload.set_mm(&manager);
      payload.acquire();
      payload.set_command(tlm::TLM_READ_COMMAND);
      payload.set_data_length(4);
      payload.set_streaming_width(4);
      if (threads) {
        sc_core::sc_spawn([this, &payload] {
          sc_time delay;
          socket->b_transport(payload, delay);
          wait(delay);
          ++answers;
          report();
        });
        continue;
      }
      Phase phase = tlm::BEGIN_REQ;
      sc_time delay;
      requesting = &payload;
      if (socket->nb_transport_fw(payload, phase, delay) == tlm::TLM_UPDATED && phase == tlm::END_REQ) {
        ++ends;
        requesting = nullptr;
      }
      while (requesting != nullptr) wait(ended);
    }
  }
  tlm::tlm_sync_enum answered(Payload& payload, Phase& phase, sc_time&) {
    if (phase == tlm::END_REQ) ++ends;
    if (requesting == &payload) {
      requesting = nullptr;
      ended.notify();
    }
    if (phase == tlm::END_REQ) return tlm::TLM_ACCEPTED;
    ++answers;
    report();
    phase = tlm::END_RESP;
    return tlm::TLM_COMPLETED;
  }
  void report() {
    if (answers == kReads) std::printf("%d END_REQ, %d answers at %s\n", ends, answers, sc_core::sc_time_stamp().to_string().c_str());
  }
};

int sc_main(int, char** argv) {
  Initiator initiator("initiator", std::strcmp(argv[1], "threads") == 0);
  Blocking blocking("blocking");
  Phased phased("phased");
  Initiator idle("idle", false);
  const bool own = std::strcmp(argv[1], "phases") == 0;
  if (own) {
    initiator.socket.bind(phased.socket);
    idle.socket.bind(blocking.socket);
  } else {
    initiator.socket.bind(blocking.socket);
    idle.socket.bind(phased.socket);
  }
  idle.answers = -1000;
  sc_core::sc_start(sc_time(1, sc_core::SC_US));
  return 0;
}
CPP
g++ -std=c++17 -O1 model.cpp -isystem usr/include -L"$library" -lsystemc -Wl,-rpath,"$library"
expect() {
  seen=$(SYSTEMC_DISABLE_COPYRIGHT_MESSAGE=1 ./a.out "$1" 2>/dev/null | grep answers)
  [ "$seen" = "$3" ] || { echo "changed: $2: $seen, not $3" && exit 1; }
  echo "$2: $seen"
}

g++ --version | head -1
expect phases "a target that ends requests" "8 END_REQ, 8 answers at 20 ns"
expect threads "eight threads, b_transport alone" "0 END_REQ, 8 answers at 20 ns"
expect non-blocking "the same target, non-blocking initiator" "0 END_REQ, 8 answers at 160 ns"
