// SPDX-License-Identifier: Apache-2.0
#include "tlm/pacer.hpp"

#include <gtest/gtest.h>

#include <random>

namespace parallax {
namespace pacer_test {

TEST(Pacer, NeverLosesAFraction) {
  // A gigabit line on a 175 MHz clock: 1.4 cycles a byte.
  Pacer pacer(8 * 175'000'000ll, 1'000'000'000);
  std::mt19937 random(1);
  std::int64_t units = 0;
  std::int64_t cycles = 0;
  for (int i = 0; i < 100'000; ++i) {
    const auto some = static_cast<std::int64_t>(random() % 1600);
    units += some;
    cycles += pacer.take(some).count();
    ASSERT_EQ(cycles, units * 7 / 5);
  }
}

TEST(Pacer, SlowUnitsTakeNothingUntilOneIsDue) {
  Pacer pacer(1, 3);
  EXPECT_EQ(pacer.take(2).count(), 0);
  EXPECT_EQ(pacer.take(1).count(), 1);
  EXPECT_EQ(pacer.take(0).count(), 0);
}

TEST(Pacer, WithoutALimitNothingTakesTime) { EXPECT_EQ(Pacer(0, 1).take(1'000'000).count(), 0); }

}  // namespace pacer_test
}  // namespace parallax
