// SPDX-License-Identifier: Apache-2.0
#include "tlm/schedule.hpp"

#include <gtest/gtest.h>

namespace parallax {
namespace schedule_test {

TEST(Schedule, EmptyPiecesAreLeftOut) {
  Schedule schedule;
  schedule.repeat(0, {fires().reads(1).writes(1)});
  schedule.repeat(5, {});
  schedule.repeat(5, {fires(0).reads(1).writes(1)});
  schedule.run(fires(0).reads(1).writes(1));
  EXPECT_TRUE(schedule.empty());
  EXPECT_TRUE(schedule.phases().empty());
  EXPECT_EQ(schedule.cycles(), 0u);
}

TEST(Schedule, SinglePiecesJoinInOneSegment) {
  Schedule schedule;
  schedule.run(fires(2).reads(1))
      .run(fires(3).writes(1))
      .repeat(4, {fires().reads(1).writes(1)})
      .run(idles(7));
  ASSERT_EQ(schedule.segments().size(), 3u);
  EXPECT_EQ(schedule.segments()[0].phase_count, 2u);
  EXPECT_EQ(schedule.segments()[1].repeat, 4u);
  EXPECT_EQ(schedule.segments()[1].first_phase, 2u);
  EXPECT_EQ(schedule.segments()[2].first_phase, 3u);
}

TEST(Schedule, SumsByHand) {
  // 10 rows of: 8 pixels at 2 cycles that read port 0 and write ports 0 and 2, 3 idle cycles; then 100 idle.
  Schedule schedule;
  schedule.repeat(10, {fires(8).reads(0b1).writes(0b101).every(2), idles(3)}).run(idles(100));
  EXPECT_EQ(schedule.cycles(), 10u * (8 * 2 + 3) + 100);
  EXPECT_EQ(schedule.consumed(0), 80u);
  EXPECT_EQ(schedule.consumed(1), 0u);
  EXPECT_EQ(schedule.produced(0), 80u);
  EXPECT_EQ(schedule.produced(1), 0u);
  EXPECT_EQ(schedule.produced(2), 80u);
}

TEST(Schedule, CountsBeyond32Bits) {
  Schedule schedule;
  schedule.repeat(1ull << 33, {fires(3).reads(1).writes(1).every(5)});
  EXPECT_EQ(schedule.cycles(), 15ull << 33);
  EXPECT_EQ(schedule.produced(0), 3ull << 33);
}

}  // namespace schedule_test
}  // namespace parallax
