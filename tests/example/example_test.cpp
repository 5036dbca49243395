// SPDX-License-Identifier: Apache-2.0
// The examples of the documentation at work: a stage of one's own between two blocks in kernel time.
#include <gtest/gtest.h>

#include <vector>

#include "tests/example/ends.hpp"
#include "tests/example/fill_from_left_stage.hpp"
#include "tests/example/slow_copy.hpp"

namespace parallax::test {
namespace example_test {

// source -> FillFromLeftStage -> SlowCopy -> sink
class Chain {
 public:
  static constexpr int kWidth = 6;
  static std::vector<Disparity> row() {
    return {{}, {100, Cause::kMatched}, {}, {}, {}, {200, Cause::kMatched}};
  }

  explicit Chain(Sending sending)
      : source_("source", row(), sending),
        fill("fill", {2}, StageTiming{}, {clock_, dataflow_, kWidth, 1}),
        slow_("slow", clock_),
        sink("sink", clock_),
        a_("a", dataflow_, clock_, clock_, {2, Bits(kDisparityBits)}),
        b_("b", dataflow_, clock_, clock_, {2, Bits(kDisparityBits)}),
        c_("c", dataflow_, clock_, clock_, {2, Bits(kDisparityBits)}) {
    source_.out(a_);
    fill.in_disparity(a_);
    fill.out_disparity(b_);
    slow_.in_disparity(b_);
    slow_.out_disparity(c_);
    sink.in(c_);
  }

 private:
  const ClockDomain clock_{"clock", Hertz(100'000'000)};
  Dataflow dataflow_{"dataflow"};
  Source source_;

 public:
  FillFromLeftStage fill;

 private:
  SlowCopy slow_;

 public:
  Sink sink;

 private:
  Stream<Disparity> a_, b_, c_;
};

TEST(Example, AStageOfOnesOwnRunsBetweenKernelTimeBlocks) {
  Chain chain(Sending::kRows);
  sc_core::sc_start();
  const std::vector<Disparity> row = Chain::row();
  const Disparity filled{100, Cause::kInterpolated};
  EXPECT_EQ(chain.sink.values, (std::vector<Disparity>{{}, row[1], filled, filled, {}, row[5]}));
  // Written in cycle 0, read by the stage in 1, written in 2, read by the slow block in 3, written in 5, read
  // in 6; then every third cycle.
  EXPECT_EQ(chain.sink.cycles, (std::vector<std::int64_t>{6, 9, 12, 15, 18, 21}));
  EXPECT_EQ(chain.fill.storage(), Bits(20));
}

TEST(Example, AValueThatIsReadBeforeItsRowIsCompleteIsReported) {
  const Chain chain(Sending::kTokens);
  try {
    sc_core::sc_start();
    FAIL() << "the value of the first token cannot be known";
  } catch (const sc_core::sc_report& report) {
    EXPECT_STREQ(report.get_msg_type(), "/parallax/stream/value");
  }
}

}  // namespace example_test
}  // namespace parallax::test
