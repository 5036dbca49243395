// SPDX-License-Identifier: Apache-2.0
// The memory target as a DRAM: every date that an initiator sees is that of an arbiter and a controller that
// are stepped clock by clock.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "tests/timing/in_child.hpp"
#include "tests/tlm/protocol_initiator.hpp"
#include "tests/tlm/thread.hpp"
#include "tlm/dram_scheduler.hpp"
#include "tlm/memory.hpp"

namespace parallax::test {
namespace dram_memory_test {

using Clock = DramController::Clock;

sc_core::sc_time ns(std::uint64_t count) {
  return sc_core::sc_time(static_cast<double>(count), sc_core::SC_NS);
}

struct Bench {
  Bench(const DramMemory& dram, const MemoryTargetConfig& target, std::size_t ports)
      : memory("memory", target, std::make_unique<DramScheduler>(dram)) {
    for (std::size_t i = 0; i < ports; ++i) {
      initiators.push_back(std::make_unique<ProtocolInitiator>(sc_core::sc_gen_unique_name("initiator")));
      initiators.back()->socket.bind(memory.socket);
    }
  }
  void thread(std::function<void()> body) {
    threads.push_back(std::make_unique<Thread>(sc_core::sc_gen_unique_name("thread"), std::move(body)));
  }
  ProtocolInitiator& operator[](std::size_t i) { return *initiators[i]; }
  Memory memory;
  std::vector<std::unique_ptr<ProtocolInitiator>> initiators;
  std::vector<std::unique_ptr<Thread>> threads;
};

struct Traffic {  // one request, and when it was and is to be served
  bool write = false;
  std::uint64_t address = 0;
  std::uint32_t bytes = 0;
  std::uint64_t called = 0;   // ps: when the initiator said so
  std::uint64_t arrival = 0;  // ps
  std::uint64_t entered = 0;  // ps: the clock after its last burst's
  std::uint64_t ready = 0;    // ps
};

/// Every clock: who may go, and what the controller does.
class SteppedMemory {
 public:
  SteppedMemory(const DramMemory& dram, std::vector<std::vector<Traffic>>& ports)
      : dram_(dram),
        controller_(dram.timing, dram.policy),
        address_(dram.timing, dram.mapping),
        ports_(ports),
        heads_(ports.size()),
        current_(ports.size() - 1) {}

  void run() {
    for (Clock clock = 0; left(); ++clock) step(clock);
  }

 private:
  struct Head {
    std::size_t index = 0;   // of the request
    std::uint64_t done = 0;  // of its bursts
  };
  struct Read {
    std::size_t port, index;
    std::uint64_t left;
    Clock end;
  };

  std::uint64_t burst() const { return static_cast<std::uint64_t>(dram_.timing.burst_bytes()); }
  std::uint64_t bursts(const Traffic& t) const {
    return (t.address + t.bytes - 1) / burst() - t.address / burst() + 1;
  }
  std::uint64_t date(Clock clock) const {
    return static_cast<std::uint64_t>(clock * dram_.timing.clock_period_ps);
  }
  bool left() const {
    for (std::size_t p = 0; p < ports_.size(); ++p) {
      if (heads_[p].index < ports_[p].size()) return true;
    }
    return !reads_.empty();
  }
  bool may_go(std::size_t p, Clock clock) const {
    if (heads_[p].index == ports_[p].size()) return false;
    const Traffic& t = ports_[p][heads_[p].index];
    return t.arrival <= date(clock) && controller_.room(t.write);
  }
  bool choose(Clock clock) {
    if (heads_[current_].done > 0 && may_go(current_, clock)) return true;
    const bool in_turn = dram_.arbitration == MemoryArbitration::kRoundRobin;
    for (std::size_t i = 0; i < ports_.size(); ++i) {
      const std::size_t p = in_turn ? (current_ + 1 + i) % ports_.size() : i;
      if (!may_go(p, clock)) continue;
      current_ = p;
      return true;
    }
    return false;
  }
  void run_until(Clock clock) {
    controller_.run_until(clock, done_);
    for (const DramController::Done& done : done_) {
      if (done.write) continue;
      for (Read& read : reads_) {
        if (read.port * 100000 + read.index != done.tag) continue;
        --read.left;
        read.end = std::max(read.end, done.data_end);
      }
    }
    done_.clear();
    // Reads of a port are answered in order.
    for (auto read = reads_.begin(); read != reads_.end();) {
      const bool first =
          std::none_of(reads_.begin(), read, [&](const Read& r) { return r.port == read->port; });
      if (!first || read->left > 0) {
        ++read;
        continue;
      }
      std::uint64_t before = 0;
      for (std::size_t i = 0; i < read->index; ++i) before = std::max(before, ports_[read->port][i].ready);
      ports_[read->port][read->index].ready = std::max(before, date(read->end + dram_.latency));
      read = reads_.erase(read);
    }
  }
  void step(Clock clock) {
    run_until(clock);
    const bool go = choose(clock);
    run_until(clock + 1);
    if (!go) return;
    Head& head = heads_[current_];
    Traffic& t = ports_[current_][head.index];
    if (head.done == 0 && !t.write) reads_.push_back({current_, head.index, bursts(t), 0});
    const std::uint64_t at = (t.address / burst() + head.done) * burst();
    controller_.submit({address_.locate(at), current_ * 100000 + head.index, t.write}, clock);
    if (++head.done < bursts(t)) return;
    t.entered = date(clock + 1);
    if (t.write) t.ready = date(clock + 1 + dram_.latency);
    head = {head.index + 1, 0};
  }

  const DramMemory dram_;
  DramController controller_;
  const DramAddress address_;
  std::vector<std::vector<Traffic>>& ports_;
  std::vector<Head> heads_;
  std::vector<Read> reads_;
  std::vector<DramController::Done> done_;
  std::size_t current_;
};

DramMemory random_dram(std::mt19937& random) {
  DramMemory dram;
  if (random() % 3 == 0) {  // bank groups
    dram.timing.bank_groups = 4;
    dram.timing.banks = 16;
    dram.timing.ccd_group = 6;
    dram.timing.wtr_group = 9;
    dram.timing.clock_period_ps = 833;
  }
  if (random() % 3 == 0) dram.timing.refi = 600 + random() % 1000;
  dram.mapping = static_cast<DramMapping>(random() % 3);
  if (random() % 2 == 0) dram.policy.efficiency = 60 + random() % 41;
  if (random() % 2 == 0) dram.policy = {4, 6, 5, 2, 3, dram.policy.efficiency};
  dram.latency = random() % 2 == 0 ? 0 : random() % 60;
  if (random() % 2 == 0) dram.arbitration = MemoryArbitration::kFixedPriority;
  return dram;
}

// Random requests of ports that read or write; what differs from the stepped memory.
std::string differences(std::uint32_t seed) {
  std::mt19937 random(seed);
  const DramMemory dram = random_dram(random);
  MemoryTargetConfig target;
  target.size = Bytes(1 << 20);
  target.queue_depth = 1 + static_cast<std::uint32_t>(random() % 4);
  const std::size_t ports = 1 + random() % 5;
  const std::uint64_t pause = random() % 3 == 0 ? 40 : 1 + random() % 4000;  // ns
  const auto size = static_cast<std::uint32_t>(1 + random() % 512);
  std::vector<std::vector<Traffic>> traffic(ports);
  Bench b(dram, target, ports);
  for (std::size_t port = 0; port < ports; ++port) {
    const bool write = random() % 3 == 0;
    const std::uint64_t start = random() % 2 == 0 ? 0 : random() % 100000;
    const std::uint32_t own_seed = static_cast<std::uint32_t>(random());
    const bool stream = random() % 2 == 0;
    b.thread([&, port, write, start, own_seed, stream] {
      std::mt19937 own(own_seed);
      std::uint64_t address = start;
      for (int i = 0; i < 80; ++i) {
        if (own() % 2 == 0) sc_core::wait(ns(own() % pause));
        if (own() % 16 == 0) sc_core::wait(sc_core::SC_ZERO_TIME);
        const std::uint32_t bytes = stream ? size : 1 + static_cast<std::uint32_t>(own()) % size;
        if (!stream) address = own() % 1000000;
        const sc_core::sc_time delay = ns(own() % 4 == 0 ? own() % 900 : 0);
        traffic[port].push_back({write, address, bytes, sc_core::sc_time_stamp().value(),
                                 (sc_core::sc_time_stamp() + delay).value(), 0, 0});
        b[port].send(write ? ::tlm::TLM_WRITE_COMMAND : ::tlm::TLM_READ_COMMAND, address, bytes, delay);
        address += bytes;
      }
    });
  }
  // Somebody who asks at any time changes nothing.
  b.thread([&b] {
    std::mt19937 own(1);
    for (int i = 0; i < 100; ++i) {
      sc_core::wait(ns(own() % 300));
      b.memory.statistics(0);
    }
  });
  sc_core::sc_start();
  // A request that comes before its forerunner's date waits for it in the queue.
  for (std::vector<Traffic>& port : traffic) {
    for (std::size_t i = 1; i < port.size(); ++i)
      port[i].arrival = std::max(port[i].arrival, port[i - 1].arrival);
  }
  SteppedMemory(dram, traffic).run();
  std::string text;
  std::uint64_t bytes = 0;
  for (std::size_t port = 0; port < ports; ++port) {
    if (b[port].responses.size() != traffic[port].size()) return "a request was never answered";
    for (std::size_t i = 0; i < traffic[port].size(); ++i) {
      const Traffic& t = traffic[port][i];
      const ProtocolInitiator::Times& times = b[port].times[i];
      bytes += t.bytes;
      // Its slot is free when an edge has passed; who waits for it gets it at the next one.
      std::uint64_t taken = times.begin_request.value();
      if (i >= target.queue_depth) {
        const std::uint64_t next_edge = traffic[port][i - target.queue_depth].entered;
        const auto period = static_cast<std::uint64_t>(dram.timing.clock_period_ps);
        if (t.called + period <= next_edge) taken = std::max(taken, next_edge);
      }
      if (times.begin_response.value() != t.ready || times.end_request.value() != taken) {
        text +=
            fmt::format("port {} request {} at {}: answered {} for {}, taken {} for {}\n", port, i, t.arrival,
                        times.begin_response.value(), t.ready, times.end_request.value(), taken);
      }
    }
  }
  if (bytes == 0) text += "nothing was asked";
  return text.substr(0, 600);
}

TEST(DramMemory, EveryDateIsThatOfTheSteppedMemory) {
  for (std::uint32_t seed = 1; seed <= 600; ++seed) {
    ASSERT_EQ(in_child([seed] { return differences(seed); }), "") << "seed " << seed;
  }
}

// memory.md's unloaded latencies: bank closed, row hit, row conflict; a burst and the interconnect more.
TEST(DramMemory, AReadAloneTakesWhatTheDevicesAndTheInterconnectTake) {
  DramMemory dram;
  dram.timing.refi = 0;
  dram.latency = 40;
  Bench b(dram, {}, 1);
  std::vector<double> latencies;
  b.thread([&] {
    for (const std::uint64_t address : {0, 64, 4096 * 8}) {
      sc_core::wait(sc_core::sc_time(1875 * 200, sc_core::SC_PS));
      const sc_core::sc_time begin = sc_core::sc_time_stamp();
      b[0].send(::tlm::TLM_READ_COMMAND, address, 64);
      b[0].wait_for_all();
      latencies.push_back((sc_core::sc_time_stamp() - begin).to_seconds() * 1e9);
    }
  });
  sc_core::sc_start();
  ASSERT_EQ(latencies.size(), 3u);
  EXPECT_NEAR(latencies[0], 43.125 + 75, 1e-6);
  EXPECT_NEAR(latencies[1], 30 + 75, 1e-6);
  EXPECT_NEAR(latencies[2], 56.25 + 75, 1e-6);
}

TEST(DramMemory, AWriteIsPosted) {
  DramMemory dram;
  dram.latency = 10;
  Bench b(dram, {}, 1);
  b.thread([&] {
    b[0].send(::tlm::TLM_WRITE_COMMAND, 0x1000, 128);  // four bursts, one a clock
    b[0].wait_for_all();
    EXPECT_EQ(sc_core::sc_time_stamp().value(), (4 + 10) * 1875u);
    b[0].send(::tlm::TLM_READ_COMMAND, 0x1000, 128);
    b[0].wait_for_all();
  });
  sc_core::sc_start();
  EXPECT_EQ(b[0].times[1].data[5], 5);  // and the read sees what was written
  ASSERT_NE(b.memory.commands(), nullptr);
  EXPECT_EQ(b.memory.commands()->reads, 4u);
  EXPECT_EQ(b.memory.commands()->writes, 4u);
  EXPECT_EQ(b.memory.commands()->activates, 1u);
}

TEST(DramMemory, AtWorkIsFromEntryToTheLastBeat) {
  DramMemory dram;
  dram.timing.refi = 0;
  Bench b(dram, {}, 1);
  b.thread([&] {
    for (int i = 0; i < 2; ++i) {
      b[0].send(::tlm::TLM_READ_COMMAND, 0, 64);
      b[0].wait_for_all();
      sc_core::wait(sc_core::sc_time(1875 * 100, sc_core::SC_PS));
    }
    EXPECT_EQ(b.memory.at_work().count(), 23 + 16);  // 43.125 and 30 ns
    EXPECT_EQ(b.memory.bus_taken(0).count(), 4 * 4);
  });
  sc_core::sc_start();
}

// Mixed reads and writes, ways to answer and late ends: the initiators check the protocol.
TEST(DramMemory, KeepsToTheBaseProtocol) {
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    const std::string text = in_child([seed] {
      std::mt19937 random(seed);
      const DramMemory dram = random_dram(random);
      MemoryTargetConfig target;
      target.queue_depth = 1 + static_cast<std::uint32_t>(random() % 4);
      Bench b(dram, target, 4);
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
      }
      if (::testing::Test::HasFailure()) found += "the protocol was broken\n";
      return found;
    });
    EXPECT_EQ(text, "") << "seed " << seed;
  }
}

// The blocking interface, as a loosely-timed initiator uses it.
TEST(DramMemory, ABlockingCallTakesTheSameTime) {
  DramMemory dram;
  dram.timing.refi = 0;
  dram.latency = 40;
  Bench b(dram, {}, 1);
  b.thread([&] {
    std::vector<std::uint8_t> data(64, 7);
    ::tlm::tlm_generic_payload payload;
    payload.set_data_ptr(data.data());
    payload.set_data_length(64);
    payload.set_streaming_width(64);
    payload.set_command(::tlm::TLM_READ_COMMAND);
    sc_core::sc_time delay(1875 * 8, sc_core::SC_PS);
    b[0].socket->b_transport(payload, delay);
    sc_core::wait(delay);
    EXPECT_EQ(sc_core::sc_time_stamp().value(), (8 + 23 + 40) * 1875u);
    EXPECT_EQ(payload.get_response_status(), ::tlm::TLM_OK_RESPONSE);
    EXPECT_EQ(data[0], 0);
  });
  sc_core::sc_start();
}

TEST(DramMemory, AnEmptyOrImpossibleRequestIsAnsweredToo) {
  Bench b({}, {}, 1);
  b.thread([&] {
    b[0].send(::tlm::TLM_READ_COMMAND, ~0ull - 10, 64);
    b[0].send(::tlm::TLM_READ_COMMAND, 100, 0);
    b[0].send(::tlm::TLM_READ_COMMAND, 0, 64);
    b[0].wait_for_all();
  });
  sc_core::sc_start();
  EXPECT_EQ(b[0].times[0].status, ::tlm::TLM_ADDRESS_ERROR_RESPONSE);
  EXPECT_EQ(b[0].times[2].status, ::tlm::TLM_OK_RESPONSE);
}

}  // namespace dram_memory_test
}  // namespace parallax::test
