// SPDX-License-Identifier: Apache-2.0
#include "tlm/schedule.hpp"

#include <gtest/gtest.h>

namespace parallax {
namespace {

TEST(Schedule, EmptyPiecesAreLeftOut) {
  Schedule schedule;
  schedule.repeat(0, {{1, 1, 1, 1}});
  schedule.repeat(5, {});
  schedule.repeat(5, {{0, 1, 1, 1}});
  schedule.run({0, 1, 1, 1});
  EXPECT_TRUE(schedule.empty());
  EXPECT_TRUE(schedule.phases().empty());
  EXPECT_EQ(schedule.cycles(), 0u);
}

TEST(Schedule, SinglePiecesJoinInOneSegment) {
  Schedule schedule;
  schedule.run({2, 1, 1, 0}).run({3, 1, 0, 1}).repeat(4, {{1, 1, 1, 1}}).run({1, 7, 0, 0});
  ASSERT_EQ(schedule.segments().size(), 3u);
  EXPECT_EQ(schedule.segments()[0].phase_count, 2u);
  EXPECT_EQ(schedule.segments()[1].repeat, 4u);
  EXPECT_EQ(schedule.segments()[1].first_phase, 2u);
  EXPECT_EQ(schedule.segments()[2].first_phase, 3u);
}

TEST(Schedule, SumsByHand) {
  // 10 rows of: 8 pixels at 2 cycles that read port 0 and write ports 0 and 2, 3 idle cycles; then 100 idle.
  Schedule schedule;
  schedule.repeat(10, {{8, 2, 0b1, 0b101}, {1, 3, 0, 0}}).run({1, 100, 0, 0});
  EXPECT_EQ(schedule.cycles(), 10u * (8 * 2 + 3) + 100);
  EXPECT_EQ(schedule.consumed(0), 80u);
  EXPECT_EQ(schedule.consumed(1), 0u);
  EXPECT_EQ(schedule.produced(0), 80u);
  EXPECT_EQ(schedule.produced(1), 0u);
  EXPECT_EQ(schedule.produced(2), 80u);
}

TEST(Schedule, CountsBeyond32Bits) {
  Schedule schedule;
  schedule.repeat(1ull << 33, {{3, 5, 1, 1}});
  EXPECT_EQ(schedule.cycles(), 15ull << 33);
  EXPECT_EQ(schedule.produced(0), 3ull << 33);
}

}  // namespace
}  // namespace parallax
