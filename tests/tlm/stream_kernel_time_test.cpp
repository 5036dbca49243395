// SPDX-License-Identifier: Apache-2.0
// What a block in kernel time can ask a stream before it reads or writes.
#include <gtest/gtest.h>

#include <string>
#include <systemc>

#include "tests/timing/in_child.hpp"
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
      const bool read = in->can_read(), write = out[0]->can_write();
      said += read && write ? 'b' : read ? 'r' : write ? 'w' : '-';
      if (cycle < 2) out[0]->write(10 + cycle);
      if (cycle == 4 || cycle == 5) {
        said += std::to_string(in->peek());
        said += std::to_string(in->read());
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

}  // namespace stream_kernel_time_test
}  // namespace parallax::test
