// SPDX-License-Identifier: Apache-2.0
// What a block in kernel time can ask a stream before it reads or writes.
#include <gtest/gtest.h>

#include <deque>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

#include "tests/timing/date_log.hpp"
#include "tests/timing/in_child.hpp"
#include "tests/tlm/thread.hpp"
#include "tlm/stream.hpp"

namespace parallax::test {
namespace stream_kernel_time_test {

/// Asks each cycle, then writes in cycles 0 and 1, and reads in cycles 4 and 5.
class Asker final : public sc_core::sc_module {
 public:
  StreamOut<int> out{"out"};
  StreamIn<int> in{"in"};
  std::string said;  ///< a letter a cycle: w, r, b(oth) or - for neither

  Asker(const sc_core::sc_module_name& name, const ClockDomain& clock) : sc_module(name), clock_(clock) {
    SC_HAS_PROCESS(Asker);
    SC_THREAD(run);
  }

 private:
  void run() {
    for (int cycle = 0; cycle < 8; ++cycle) {
      clock_.wait_until(Cycles(cycle));
      const bool read = in.can_read(), write = out.can_write();
      said += read && write ? 'b' : read ? 'r' : write ? 'w' : '-';
      if (cycle < 2) out.write(10 + cycle);
      if (cycle == 4 || cycle == 5) {
        said += std::to_string(in.peek());
        said += std::to_string(in.read());
      }
    }
  }
  const ClockDomain& clock_;
};

TEST(StreamInKernelTime, SaysWhatCanBeDoneInTheCycle) {
  EXPECT_EQ(in_child([] {
              const ClockDomain clock("clock", Hertz(100'000'000));
              Dataflow dataflow("dataflow");
              FifoConfig config;
              config.depth = 2;
              Stream<int> stream("stream", dataflow, clock, clock, config);
              Asker asker("asker", clock);
              asker.out(stream);
              asker.in(stream);
              sc_core::sc_start();
              return asker.said;
            }),
            // Registered both ways: readable a cycle after the write, a slot free a cycle after the read.
            "wbrrr1010b1111ww");
}

struct Fork {
  Fork() : clock("clock", Hertz(100'000'000)), dataflow("dataflow") {
    FifoConfig config;
    for (const std::uint32_t depth : {1u, 3u}) {
      config.depth = depth;
      streams.push_back(std::make_unique<Stream<int>>(("stream_" + std::to_string(depth)).c_str(), dataflow,
                                                      clock, clock, config));
      streams.back()->add_listener(logs.emplace_back(dates.emplace_back()));
    }
  }
  ClockDomain clock;
  Dataflow dataflow;
  std::vector<std::unique_ptr<Stream<int>>> streams;  // of depths 1 and 3
  std::deque<EdgeDates> dates;
  std::deque<DateLog> logs;
};

/// Writes the numbers from 0 on as fast as it can.
class Writer final : public sc_core::sc_module {
 public:
  StreamOut<int> out{"out"};
  explicit Writer(const sc_core::sc_module_name& name) : sc_module(name) {
    SC_HAS_PROCESS(Writer);
    SC_THREAD(run);
  }

 private:
  void run() {
    for (int i = 0;; ++i) out.write(i);
  }
};

TEST(StreamInKernelTime, AForkIsWrittenInTheCycleInWhichAllHaveRoom) {
  Fork fork;
  Writer writer("writer");
  std::vector<int> values;
  const auto read = [&](std::size_t stream, Cycles cycle) {
    fork.clock.wait_until(cycle);
    values.push_back(fork.streams[stream]->read());
  };
  Thread slow("slow", [&] {
    for (const int cycle : {10, 20, 30}) read(0, Cycles(cycle));
  });
  Thread fast("fast", [&] {
    for (int i = 0; i < 4; ++i) read(1, Cycles(0));
  });
  for (auto& stream : fork.streams) writer.out(*stream);
  sc_core::sc_start(sc_core::sc_time(1, sc_core::SC_US));
  const std::vector<std::int64_t> dates{0, 11, 21, 31};
  EXPECT_EQ(fork.dates[0].written, dates);
  EXPECT_EQ(fork.dates[1].written, dates);
  EXPECT_EQ(values, (std::vector<int>{0, 0, 1, 1, 2, 2, 3}));
  EXPECT_FALSE(writer.out.can_write());
}

// A picosecond behind an edge the present cycle is the next one.
TEST(StreamInKernelTime, WhoCountsCyclesHimselfNamesThem) {
  Fork fork;
  Stream<int>& stream = *fork.streams[0];
  bool said = false;
  Thread block("block", [&] {
    sc_core::wait(sc_core::sc_time(1, sc_core::SC_PS));
    ASSERT_TRUE(stream.can_write(Cycles(0)));
    stream.write(7, Cycles(0), Cycles(0));
    EXPECT_FALSE(stream.can_write(Cycles(1)));
    EXPECT_FALSE(stream.can_read(Cycles(0)));
    EXPECT_TRUE(stream.can_read());  // in cycle 1
    ASSERT_TRUE(stream.can_read(Cycles(1)));
    EXPECT_FALSE(stream.read_date_known(1));
    EXPECT_EQ(stream.read(Cycles(1), Cycles(1)), 7);
    EXPECT_EQ(stream.statistics().starved_on_empty, Cycles(1));
    said = true;
  });
  sc_core::sc_start();
  EXPECT_TRUE(said);
}

TEST(StreamInKernelTime, AValueThatHasNotBeenSentIsReported) {
  Fork fork;
  Stream<int>& stream = *fork.streams[0];
  std::string fault;
  Thread block("block", [&] {
    stream.commit();
    try {
      stream.peek();
    } catch (const sc_core::sc_report& report) {
      fault = std::string(report.get_msg_type()) + " " + report.get_msg();
    }
  });
  sc_core::sc_start();
  EXPECT_EQ(fault, "/parallax/stream/value stream_1");
}

}  // namespace stream_kernel_time_test
}  // namespace parallax::test
