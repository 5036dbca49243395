// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <vector>

#include "tests/tlm/bus_memory.hpp"
#include "tests/tlm/protocol_initiator.hpp"
#include "tests/tlm/thread.hpp"

namespace parallax::test {

using Nanoseconds = std::vector<double>;

/// A cycle is a nanosecond; 8 B a cycle; 10 cycles of latency.
inline BusMemory timing() {
  BusMemory t;
  t.size = Bytes(1 << 16);
  t.bytes_per_cycle = Bytes(8);
  t.latency = Cycles(10);
  return t;
}

/// A memory on a bus, with initiators that check the protocol.
struct Bench {
  explicit Bench(const BusMemory& t = timing(), int ports = 1, std::int64_t hz = 1'000'000'000)
      : clock("memory", Hertz(hz)), memory("memory", t, clock) {
    for (int i = 0; i < ports; ++i) {
      initiators.push_back(std::make_unique<ProtocolInitiator>(sc_core::sc_gen_unique_name("initiator")));
      initiators.back()->socket.bind(memory.socket);
    }
  }
  ProtocolInitiator& operator[](std::size_t i) { return *initiators[i]; }
  /// The body runs as a thread of its own.
  void thread(std::function<void()> body) {
    threads.push_back(std::make_unique<Thread>(sc_core::sc_gen_unique_name("thread"), std::move(body)));
  }
  Nanoseconds responses(std::size_t port = 0) const {
    Nanoseconds all;
    for (const auto& t : initiators[port]->times) all.push_back(t.begin_response.to_seconds() * 1e9);
    return all;
  }
  Nanoseconds end_requests(std::size_t port = 0) const {
    Nanoseconds all;
    for (const auto& t : initiators[port]->times) all.push_back(t.end_request.to_seconds() * 1e9);
    return all;
  }
  ClockDomain clock;
  BusMemoryTarget memory;
  std::vector<std::unique_ptr<ProtocolInitiator>> initiators;
  std::vector<std::unique_ptr<Thread>> threads;
};

inline void expect_near(const Nanoseconds& have, const Nanoseconds& want) {
  ASSERT_EQ(have.size(), want.size());
  for (std::size_t i = 0; i < want.size(); ++i) EXPECT_NEAR(have[i], want[i], 1e-3) << "request " << i;
}

template <class Number>
sc_core::sc_time ns(Number t) {
  return sc_core::sc_time(static_cast<double>(t), sc_core::SC_NS);
}

}  // namespace parallax::test
