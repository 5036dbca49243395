// SPDX-License-Identifier: Apache-2.0
// The memory as its data sheet: bandwidth, latency, arbitration, queues, and the rules of the base protocol.
#include "tlm/memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/timing/in_child.hpp"
#include "tests/tlm/memory_bench.hpp"
#include "tlm/traffic_only.hpp"

namespace parallax::test {
namespace memory_test {

TEST(Memory, ABurstTakesItsBytesAtTheBusRateRoundedUp) {
  Bench b;
  b.thread([&] {
    for (const std::size_t bytes : {128u, 100u, 8u, 1u}) {
      b[0].send(::tlm::TLM_READ_COMMAND, 0, bytes);
      b[0].wait_for_all();
    }
  });
  sc_core::sc_start();
  expect_near(b.responses(), {26, 26 + 23, 49 + 11, 60 + 11});
}

TEST(Memory, WithoutDataTheTimeIsTheSame) {
  BusMemory t = timing();
  t.holds_data = false;
  Bench b(t);
  b.thread([&] {
    for (const std::size_t bytes : {128u, 100u, 8u, 1u}) {
      b[0].send(bytes == 100u ? ::tlm::TLM_WRITE_COMMAND : ::tlm::TLM_READ_COMMAND, 0, bytes);
      b[0].wait_for_all();
    }
  });
  sc_core::sc_start();
  expect_near(b.responses(), {26, 26 + 23, 49 + 11, 60 + 11});
  EXPECT_EQ(b.memory.statistics(0).written_bytes, 100u);
  EXPECT_EQ(b.memory.statistics(0).read_bytes, 137u);
}

TEST(Memory, EfficiencyStretchesTheBus) {
  BusMemory t = timing();
  t.efficiency = 80;  // 6.4 B a cycle
  Bench b(t);
  b.thread([&] {
    for (const std::size_t bytes : {128u, 100u, 1u}) {
      b[0].send(::tlm::TLM_READ_COMMAND, 0, bytes);
      b[0].wait_for_all();
    }
  });
  sc_core::sc_start();
  expect_near(b.responses(), {30, 30 + 26, 56 + 11});
  EXPECT_DOUBLE_EQ(b.memory.usable_bandwidth(), 6.4e9);
}

TEST(Memory, BurstsFollowWithoutAGapAndLatenciesOverlap) {
  Bench b;
  b.thread([&] {
    for (int i = 0; i < 6; ++i) b[0].send(::tlm::TLM_READ_COMMAND, 0, 64);
  });
  sc_core::sc_start();
  expect_near(b.responses(), {18, 26, 34, 42, 50, 58});
}

TEST(Memory, ServiceBeginsAtAClockEdge) {
  Bench b(timing(), 1, 300'000'000);
  b.thread([&] {
    sc_core::wait(4, sc_core::SC_NS);  // edge 2 is at 6.67 ns
    b[0].send(::tlm::TLM_READ_COMMAND, 0, 8);
  });
  sc_core::sc_start();
  expect_near(b.responses(), {(2 + 1 + 10) / 0.3});
}

TEST(Memory, RoundRobinServesThePortsInTurn) {
  Bench b(timing(), 3);
  for (std::size_t port = 0; port < 3; ++port) {
    b.thread([&b, port] {
      for (int i = 0; i < 2; ++i) b[port].send(::tlm::TLM_READ_COMMAND, 0, 64);
    });
  }
  sc_core::sc_start();
  expect_near(b.responses(0), {18, 42});
  expect_near(b.responses(1), {26, 50});
  expect_near(b.responses(2), {34, 58});
}

TEST(Memory, FixedPriorityServesTheFirstPortFirst) {
  BusMemory t = timing();
  t.arbitration = MemoryArbitration::kFixedPriority;
  Bench b(t, 3);
  for (std::size_t port = 0; port < 3; ++port) {
    b.thread([&b, port] {
      for (int i = 0; i < 2; ++i) b[port].send(::tlm::TLM_READ_COMMAND, 0, 64);
    });
  }
  sc_core::sc_start();
  expect_near(b.responses(0), {18, 26});
  expect_near(b.responses(1), {34, 42});
  expect_near(b.responses(2), {50, 58});
}

// The ports send at the same time, at an edge, but run by the kernel in any order.
TEST(Memory, WhoIsServedFirstDoesNotDependOnDeltaCycles) {
  for (const std::uint32_t queue_depth : {4u, 1u}) {
    std::string expected;
    for (std::uint32_t seed = 0; seed < 24; ++seed) {
      const std::string text = in_child([&] {
        BusMemory t = timing();
        t.queue_depth = queue_depth;
        Bench b(t, 3);
        std::mt19937 random(seed);
        for (std::size_t port = 0; port < 3; ++port) {
          const auto deltas = static_cast<std::uint32_t>(queue_depth == 1 ? seed % 2 : random() % 5);
          b.thread([&b, port, deltas] {
            for (int i = 0; i < 3; ++i) {
              sc_core::wait(ns(40 * (i + 1)) - sc_core::sc_time_stamp());
              for (std::uint32_t delta = 0; delta < deltas; ++delta) sc_core::wait(sc_core::SC_ZERO_TIME);
              b[port].send(::tlm::TLM_READ_COMMAND, 0, 48);
              b[port].send(::tlm::TLM_READ_COMMAND, 0, 48);
            }
          });
        }
        sc_core::sc_start();
        std::string all;
        for (std::size_t port = 0; port < 3; ++port) {
          for (const double time : b.responses(port)) all += std::to_string(time) + " ";
        }
        return all;
      });
      if (seed == 0) expected = text;
      EXPECT_EQ(text, expected) << "queue depth " << queue_depth << ", seed " << seed;
    }
    EXPECT_NE(expected.find("56.000000"), std::string::npos);  // the first port's first: 40 + 6 + 10
  }
}

TEST(Memory, AnswersThatAreKnownAreToldTogetherWithTheirDates) {
  Bench b(timing(), 3);
  for (std::size_t port = 0; port < 3; ++port) {
    b.thread([&b, port] { b[port].send(::tlm::TLM_READ_COMMAND, 0, 64, ns(port)); });
  }
  sc_core::sc_start();
  for (std::size_t port = 0; port < 3; ++port) {
    expect_near(b.responses(port), {18.0 + 8 * static_cast<double>(port)});
    EXPECT_EQ(b[port].times[0].told, ns(18));
  }
}

TEST(Memory, CountsWhatHasHappenedAndNoMore) {
  Bench b(timing(), 2);
  for (std::size_t port = 0; port < 2; ++port) {
    b.thread([&b, port] { b[port].send(::tlm::TLM_READ_COMMAND, 0, 64); });
  }
  // Served at 0 and 8, for 8 each; answered at 18 and 26.
  b.thread([&b] {
    for (int t = 0; t < 30; ++t) {
      sc_core::wait(ns(t + 0.5) - sc_core::sc_time_stamp());
      for (int port = 0; port < 2; ++port) {
        const auto id = static_cast<std::size_t>(port);
        EXPECT_EQ(b.memory.statistics(id).requests, t >= 8 * port ? 1u : 0u) << t;
        EXPECT_EQ(b.memory.statistics(id).read_bytes, t >= 8 * port ? 64u : 0u) << t;
        EXPECT_EQ(b.memory.bus_taken(id).count(), std::clamp(t + 1 - 8 * port, 0, 8)) << t;
        EXPECT_EQ(b.memory.statistics(id).latency_sum, ns(t >= 18 + 8 * port ? 18 + 8 * port : 0)) << t;
      }
    }
  });
  sc_core::sc_start();
}

TEST(Memory, AFullQueueHoldsBackTheEndOfTheRequest) {
  BusMemory t = timing();
  t.queue_depth = 2;
  Bench b(t);
  b.thread([&] {
    for (int i = 0; i < 6; ++i) b[0].send(::tlm::TLM_READ_COMMAND, 0, 64);
  });
  sc_core::sc_start();
  // The first leaves the queue at once; each further one makes room when its service begins.
  expect_near(b.end_requests(), {0, 0, 0, 8, 16, 24});
  expect_near(b.responses(), {18, 26, 34, 42, 50, 58});
  EXPECT_EQ(b.memory.statistics(0).latency_largest, ns(58 - 16));  // from BEGIN_REQ, taken or not
}

TEST(Memory, LatencyCountsFromBeginReqEvenWhenTheRequestIsNotTakenYet) {
  BusMemory t = timing();
  t.queue_depth = 1;
  Bench b(t);
  b.thread([&] {
    for (int i = 0; i < 3; ++i) b[0].send(::tlm::TLM_READ_COMMAND, 0, 64);
  });
  sc_core::sc_start();
  // BEGIN_REQ at 0, 0 and 0: the second is taken when the first is served, the third waits for that until 8.
  expect_near(b.end_requests(), {0, 0, 8});
  EXPECT_EQ(b.memory.statistics(0).latency_sum, ns(18 + 26 + 34));
  EXPECT_EQ(b.memory.statistics(0).latency_largest, ns(34));
}

TEST(Memory, AnAnnotatedDelayIsTheTimeOfTheRequest) {
  BusMemory t = timing();
  t.queue_depth = 1;
  Bench b(t);
  b.thread([&] {
    b[0].send(::tlm::TLM_READ_COMMAND, 0, 64, ns(5.5));  // served at edge 6
    b[0].send(::tlm::TLM_READ_COMMAND, 0, 64, ns(100));  // its slot is free before it comes
  });
  sc_core::sc_start();
  expect_near(b.responses(), {6 + 18, 100 + 18});
  expect_near(b.end_requests(), {5.5, 100});
}

TEST(Memory, ALateEndOfAResponseHoldsBackTheNextOneOfThatPortOnly) {
  Bench b(timing(), 2);
  b[0].answer = ProtocolInitiator::Answer::kLater;
  b[0].answer_delay = ns(40);
  for (std::size_t port = 0; port < 2; ++port) {
    b.thread([&b, port] {
      for (int i = 0; i < 3; ++i) b[port].send(::tlm::TLM_READ_COMMAND, 0, 64);
    });
  }
  sc_core::sc_start();
  expect_near(b.responses(0), {18, 58, 98});
  expect_near(b.responses(1), {26, 42, 58});
}

TEST(Memory, AnEndOfAResponseDatedLaterDoesTheSame) {
  for (const auto answer : {ProtocolInitiator::Answer::kCompleted, ProtocolInitiator::Answer::kUpdated}) {
    const std::string text = in_child([&] {
      Bench b;
      b[0].answer = answer;
      b[0].answer_delay = ns(40);
      b.thread([&] {
        for (int i = 0; i < 3; ++i) b[0].send(::tlm::TLM_READ_COMMAND, 0, 64);
      });
      sc_core::sc_start();
      std::string all;
      for (const double t : b.responses()) all += std::to_string(t) + " ";
      return all;
    });
    EXPECT_EQ(text, "18.000000 58.000000 98.000000 ");
  }
}

// The same requests one after the other, through either interface.
std::string one_by_one(bool blocking, std::uint32_t seed) {
  Bench b(timing(), 2, 333'333'333);
  std::string text;
  for (std::size_t port = 0; port < 2; ++port) {
    b.thread([&b, &text, port, blocking, seed] {
      std::mt19937 random(seed + static_cast<std::uint32_t>(port));
      std::vector<std::uint8_t> data(256);
      for (int i = 0; i < 40; ++i) {
        sc_core::wait(ns(random() % 30));
        const std::size_t length = 1 + random() % 256;
        sc_core::sc_time delay = ns(random() % 5);
        if (blocking) {
          ::tlm::tlm_generic_payload payload;
          payload.set_command(::tlm::TLM_READ_COMMAND);
          payload.set_data_ptr(data.data());
          payload.set_data_length(static_cast<unsigned>(length));
          payload.set_streaming_width(static_cast<unsigned>(length));
          b[port].socket->b_transport(payload, delay);
          sc_core::wait(delay);
        } else {
          b[port].send(::tlm::TLM_READ_COMMAND, 0, length, delay);
          b[port].wait_for_all();
        }
        text += std::to_string(port) + " " + sc_core::sc_time_stamp().to_string() + ", ";
      }
    });
  }
  sc_core::sc_start();
  return text;
}

TEST(Memory, BlockingAndNonBlockingTakeTheSameTime) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const std::string expected = in_child([&] { return one_by_one(true, seed); });
    EXPECT_GT(expected.size(), 80u * 5);
    EXPECT_EQ(in_child([&] { return one_by_one(false, seed); }), expected);
  }
}

TEST(Memory, WhatIsWrittenIsRead) {
  Bench b;
  b.thread([&] {
    b[0].send(::tlm::TLM_WRITE_COMMAND, 0x123, 200);  // byte i has the value of its address
    b[0].send(::tlm::TLM_READ_COMMAND, 0x120, 16);
    b[0].wait_for_all();
  });
  sc_core::sc_start();
  const std::vector<std::uint8_t> expected{0,    0,    0,    0x23, 0x24, 0x25, 0x26, 0x27,
                                           0x28, 0x29, 0x2A, 0x2B, 0x2C, 0x2D, 0x2E, 0x2F};
  EXPECT_EQ(b[0].times[1].data, expected);
  const MemoryPortStatistics& s = b.memory.statistics(0);
  EXPECT_EQ(s.written_bytes, 200u);
  EXPECT_EQ(s.read_bytes, 16u);
  EXPECT_EQ(s.bytes(), 216u);
  EXPECT_EQ(s.requests, 2u);
  EXPECT_EQ(b.memory.bus_taken(0).count(), 25 + 2);
}

TEST(Memory, DebugAccessTakesNoTime) {
  Bench b;
  const auto access = [&b](::tlm::tlm_command command, std::uint64_t address,
                           std::vector<std::uint8_t>& data) {
    ::tlm::tlm_generic_payload payload;
    payload.set_command(command);
    payload.set_address(address);
    payload.set_data_ptr(data.data());
    payload.set_data_length(static_cast<unsigned>(data.size()));
    payload.set_streaming_width(payload.get_data_length());
    return b[0].socket->transport_dbg(payload);
  };
  std::vector<std::uint8_t> data{1, 2, 3, 4};
  std::vector<std::uint8_t> back(4);
  b.thread([&] {
    EXPECT_EQ(access(::tlm::TLM_WRITE_COMMAND, (1 << 16) - 4, data), 4u);
    EXPECT_EQ(access(::tlm::TLM_READ_COMMAND, (1 << 16) - 4, back), 4u);
    EXPECT_EQ(access(::tlm::TLM_READ_COMMAND, (1 << 16) - 3, data), 0u);  // one byte too far
  });
  sc_core::sc_start();
  EXPECT_EQ(back, data);
  EXPECT_EQ(sc_core::sc_time_stamp(), sc_core::SC_ZERO_TIME);
  EXPECT_EQ(b.memory.statistics(0).requests, 0u);
}

TEST(Memory, LeavesOutBytesThatMeanNothing) {
  TrafficOnly traffic_only;  // the payloads, which b holds, name it to their end
  Bench b;
  b.thread([&] {
    b[0].send(::tlm::TLM_WRITE_COMMAND, 0x40, 8);
    ::tlm::tlm_generic_payload& write = b[0].take(::tlm::TLM_WRITE_COMMAND, 0x40, 8);
    write.set_extension(&traffic_only);
    b[0].send(write);
    b[0].send(::tlm::TLM_READ_COMMAND, 0x40, 8);
    ::tlm::tlm_generic_payload& outside = b[0].take(::tlm::TLM_WRITE_COMMAND, 1 << 16, 8);
    outside.set_extension(&traffic_only);
    b[0].send(outside);
  });
  sc_core::sc_start();
  expect_near(b.responses(), {11, 12, 13, 14});
  EXPECT_EQ(b[0].times[2].data[0], 0x40);
  EXPECT_EQ(b[0].times[1].status, ::tlm::TLM_OK_RESPONSE);
  EXPECT_EQ(b[0].times[3].status, ::tlm::TLM_ADDRESS_ERROR_RESPONSE);
}

// Many ports, random lengths, pauses and ways to answer; the initiators check the protocol.
TEST(Memory, KeepsToTheBaseProtocol) {
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    const std::string text = in_child([seed] {
      std::mt19937 random(seed);
      BusMemory t = timing();
      t.queue_depth = 1 + static_cast<std::uint32_t>(random() % 4);
      if (random() % 2 == 0) t.arbitration = MemoryArbitration::kFixedPriority;
      Bench b(t, 4, 171'999'997);
      for (std::size_t port = 0; port < 4; ++port) {
        b[port].answer = static_cast<ProtocolInitiator::Answer>(random() % 3);
        b[port].answer_delay = ns(random() % 3 == 0 ? random() % 60 : 0);
        b.thread([&b, port, seed] {
          std::mt19937 own(seed * 100 + static_cast<std::uint32_t>(port));
          for (int i = 0; i < 60; ++i) {
            if (own() % 3 == 0) sc_core::wait(ns(own() % 300));
            b[port].send(own() % 2 == 0 ? ::tlm::TLM_READ_COMMAND : ::tlm::TLM_WRITE_COMMAND, own() % 1000,
                         1 + own() % 300, ns(own() % 4 == 0 ? own() % 50 : 0));
          }
          b[port].wait_for_all();
        });
      }
      sc_core::sc_start();
      std::string found;
      for (std::size_t port = 0; port < 4; ++port) {
        if (b[port].responses.size() != 60) found += "a request was never answered\n";
        for (std::size_t i = 0; i < b[port].responses.size(); ++i) {
          if (b[port].responses[i] != i) found += "answers out of order\n";
        }
      }
      if (::testing::Test::HasFailure()) found += "the protocol was broken\n";
      return found;
    });
    EXPECT_EQ(text, "") << "seed " << seed;
  }
}

}  // namespace memory_test
}  // namespace parallax::test
