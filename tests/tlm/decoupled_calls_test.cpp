// SPDX-License-Identifier: Apache-2.0
// Blocking calls with dates ahead of the kernel's time: temporal decoupling.
#include <gtest/gtest.h>
#include <tlm_utils/tlm_quantumkeeper.h>

#include <map>
#include <random>

#include "tests/timing/in_child.hpp"
#include "tests/tlm/memory_bench.hpp"
#include "tlm/dram_scheduler.hpp"

namespace parallax::test {
namespace decoupled_calls_test {

/// A read of 64 bytes with this delay; returns the date of its end, ns.
template <class Socket>
double read(Socket& socket, sc_core::sc_time delay, std::uint64_t address = 0) {
  std::vector<std::uint8_t> data(64);
  ::tlm::tlm_generic_payload payload;
  payload.set_command(::tlm::TLM_READ_COMMAND);
  payload.set_address(address);
  payload.set_data_ptr(data.data());
  payload.set_data_length(64);
  payload.set_streaming_width(64);
  socket->b_transport(payload, delay);
  EXPECT_EQ(delay, sc_core::SC_ZERO_TIME);
  return sc_core::sc_time_stamp().to_seconds() * 1e9;
}

// 64 bytes take 8 ns on the bus and 10 ns of latency.
TEST(DecoupledCalls, OnePortServesThemInTheOrderOfTheirDates) {
  Bench b;
  std::map<int, double> ends;
  for (const int ahead : {1000, 0, 500, 1001, 4}) {
    b.thread([&b, &ends, ahead] { ends[ahead] = read(b[0].socket, ns(ahead)); });
  }
  sc_core::sc_start();
  const std::map<int, double> expected{{0, 18}, {4, 8 + 18}, {500, 518}, {1000, 1018}, {1001, 1008 + 18}};
  ASSERT_EQ(ends.size(), expected.size());
  for (const auto& [ahead, end] : expected) EXPECT_NEAR(ends[ahead], end, 1e-3) << ahead;
}

TEST(DecoupledCalls, OfOneDateTheFirstCallIsServedFirst) {
  Bench b;
  std::vector<int> order;
  b.thread([&] {
    read(b[0].socket, ns(100));
    order.push_back(1);
  });
  b.thread([&] {
    sc_core::wait(ns(40));
    read(b[0].socket, ns(60));
    order.push_back(2);
  });
  b.thread([&] {
    sc_core::wait(ns(100));
    read(b[0].socket, ns(0));
    order.push_back(3);
  });
  sc_core::sc_start();
  EXPECT_EQ(order, std::vector<int>({1, 2, 3}));
}

// What is under way when an earlier call comes is no longer moved.
TEST(DecoupledCalls, ACallThatIsServedIsNotOvertaken) {
  Bench b;
  double first = 0, second = 0;
  b.thread([&] { first = read(b[0].socket, ns(10)); });
  b.thread([&] {
    sc_core::wait(ns(12));
    second = read(b[0].socket, ns(0));
  });
  sc_core::sc_start();
  EXPECT_NEAR(first, 28, 1e-3);
  EXPECT_NEAR(second, 10 + 16 + 10, 1e-3);
}

// A quantum keeper's local time begins anew with each call.
TEST(DecoupledCalls, AQuantumKeeperIsInStepAfterACall) {
  Bench b;
  b.thread([&] {
    tlm_utils::tlm_quantumkeeper keeper;
    ::tlm::tlm_global_quantum::instance().set(ns(1000));
    keeper.reset();
    for (int i = 0; i < 3; ++i) {
      keeper.inc(ns(100));
      sc_core::sc_time local = keeper.get_local_time();
      ::tlm::tlm_generic_payload payload;
      std::vector<std::uint8_t> data(64);
      payload.set_command(::tlm::TLM_WRITE_COMMAND);
      payload.set_data_ptr(data.data());
      payload.set_data_length(64);
      payload.set_streaming_width(64);
      b[0].socket->b_transport(payload, local);
      keeper.set(local);
    }
    EXPECT_EQ(keeper.get_current_time(), ns(3 * 118));
  });
  sc_core::sc_start();
}

/// The ends of random calls by several threads of each port, either ahead of the kernel's time or at their
/// dates.
std::string ends(bool ahead, std::uint32_t seed, bool dram) {
  const auto run = [&](auto& socket_of, auto&& thread) {
    std::mt19937 random(seed);
    std::map<int, double> all;
    for (int i = 0; i < 30; ++i) {
      const std::size_t port = random() % 2;
      // No two of one date: which of those is first, only the order of calls says.
      const std::int64_t begin = random() % 5 * 100;
      const std::int64_t delay = static_cast<std::int64_t>(random() % 900 / 100 * 100) + i;
      const std::uint64_t address = random() % 512 * 64;
      thread([&all, &socket_of, i, port, begin, delay, address, ahead] {
        sc_core::wait(ns(ahead ? begin : begin + delay));
        all[i] = read(socket_of(port), ns(ahead ? delay : 0), address);
      });
    }
    sc_core::sc_start();
    std::string text;
    for (const auto& [number, end] : all) text += std::to_string(number) + ": " + std::to_string(end) + "\n";
    return text;
  };
  if (!dram) {
    Bench b(timing(), 2, 333'333'333);
    const auto socket_of = [&](std::size_t port) -> auto& { return b[port].socket; };
    return run(socket_of, [&](auto body) { b.thread(body); });
  }
  MemoryTargetConfig target;
  target.size = Bytes(1 << 16);
  Memory memory("memory", target, std::make_unique<DramScheduler>(DramMemory{}));
  ProtocolInitiator first("first"), second("second");
  first.socket.bind(memory.socket);
  second.socket.bind(memory.socket);
  std::vector<std::unique_ptr<Thread>> threads;
  const auto socket_of = [&](std::size_t port) -> auto& { return port == 0 ? first.socket : second.socket; };
  return run(socket_of, [&](auto body) {
    threads.push_back(std::make_unique<Thread>(sc_core::sc_gen_unique_name("thread"), body));
  });
}

TEST(DecoupledCalls, EndWhenThoseOfInitiatorsInStepDo) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    for (const bool dram : {false, true}) {
      const std::string expected = in_child([&] { return ends(false, seed, dram); });
      EXPECT_EQ(std::count(expected.begin(), expected.end(), '\n'), 30) << expected;
      EXPECT_EQ(in_child([&] { return ends(true, seed, dram); }), expected) << "seed " << seed << " " << dram;
    }
  }
}

}  // namespace decoupled_calls_test
}  // namespace parallax::test
