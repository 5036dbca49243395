// SPDX-License-Identifier: Apache-2.0
#include "tlm/cycle_accumulator.hpp"

#include <gtest/gtest.h>

#include <random>

namespace parallax {
namespace cycle_accumulator_test {

TEST(CycleAccumulator, NeverLosesAFraction) {
  // A gigabit line on a 175 MHz clock: 1.4 cycles a byte.
  CycleAccumulator accumulator(8 * 175'000'000ll, 1'000'000'000);
  std::mt19937 random(1);
  std::int64_t units = 0;
  std::int64_t cycles = 0;
  for (int i = 0; i < 100'000; ++i) {
    const auto some = static_cast<std::int64_t>(random() % 1600);
    units += some;
    cycles += accumulator.take(some).count();
    ASSERT_EQ(cycles, units * 7 / 5);
  }
}

TEST(CycleAccumulator, SlowUnitsTakeNothingUntilOneIsDue) {
  CycleAccumulator accumulator(1, 3);
  EXPECT_EQ(accumulator.take(2).count(), 0);
  EXPECT_EQ(accumulator.take(1).count(), 1);
  EXPECT_EQ(accumulator.take(0).count(), 0);
}

TEST(CycleAccumulator, WithoutALimitNothingTakesTime) {
  EXPECT_EQ(CycleAccumulator(0, 1).take(1'000'000).count(), 0);
}

}  // namespace cycle_accumulator_test
}  // namespace parallax
