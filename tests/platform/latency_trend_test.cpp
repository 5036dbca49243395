// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/latency_trend.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

namespace parallax::test {
namespace latency_trend_test {

sc_core::sc_time us(double value) { return sc_core::sc_time(value, sc_core::SC_US); }

TEST(LatencyTrend, EqualLatenciesHaveNone) {
  LatencyTrend trend(4, us(0.1));
  for (std::size_t frame = 0; frame < 30; ++frame) EXPECT_FALSE(trend.add(frame, us(5000)));
  EXPECT_TRUE(trend.known());
  EXPECT_TRUE(trend.settled());
  EXPECT_EQ(trend.slope(), 0);
}

TEST(LatencyTrend, IsKnownAfterThreeFrames) {
  LatencyTrend trend(4, us(0.1));
  for (std::size_t frame = 0; frame < 6; ++frame) trend.add(frame, us(5000));
  EXPECT_FALSE(trend.known());
  EXPECT_FALSE(trend.settled());
  trend.add(6, us(5000));
  EXPECT_TRUE(trend.known());
  EXPECT_TRUE(trend.settled());
}

TEST(LatencyTrend, AQueueThatFillsHasOneUntilItIsFull) {
  LatencyTrend trend(0, us(0.1));
  for (std::size_t frame = 0; frame < 40; ++frame) {
    EXPECT_EQ(trend.add(frame, us(5000.0 + 18.0 * static_cast<double>(frame))),
              frame % LatencyTrend::kBlock == LatencyTrend::kBlock - 1);
    EXPECT_EQ(trend.settled(), false) << frame;
  }
  EXPECT_NEAR(trend.slope(), 18e-6, 1e-9);
  // The block in which it is full rises too, the next one does not.
  for (std::size_t frame = 40; frame < 56; ++frame) trend.add(frame, us(5720));
  EXPECT_TRUE(trend.settled());
  EXPECT_EQ(trend.slope(), 0);
}

// A queue that is full within a block, after which the phases of clocks remain.
TEST(LatencyTrend, ABlockInWhichItEndsHasOne) {
  for (std::size_t rising = 1; rising < LatencyTrend::kBlock; ++rising) {
    LatencyTrend trend(0, us(0.1));
    std::size_t begins = 0;
    for (std::size_t frame = 0; frame < 40; ++frame) {
      const auto full = static_cast<double>(std::min(frame, rising));
      const double phase = frame % 2 == 0 ? 0.04 : 0;
      if (trend.add(frame, us(5000 + 300 * full + phase))) begins = frame + 1;
    }
    EXPECT_EQ(begins, 2 * LatencyTrend::kBlock) << rising;
    EXPECT_TRUE(trend.settled()) << rising;
  }
}

TEST(LatencyTrend, AQueueThatEmptiesHasOne) {
  LatencyTrend trend(0, us(0.1));
  for (std::size_t frame = 0; frame < 3; ++frame)
    trend.add(frame, us(5000.0 - 4.0 * static_cast<double>(frame)));
  EXPECT_FALSE(trend.settled());
  EXPECT_NEAR(trend.slope(), -4e-6, 1e-9);
}

// Three frames that happen to rise by less than the tolerance, though a whole block at that pace would not.
TEST(LatencyTrend, AFewFramesThatRiseALittleHaveNone) {
  LatencyTrend trend(0, us(0.5));
  for (const double latency : {4218.0, 4218.2, 4218.4}) trend.add(0, us(latency));
  EXPECT_TRUE(trend.settled());
  EXPECT_EQ(trend.slope(), 0);
}

// Phases of clocks: a few cycles; the refresh and jitter: up and down.
TEST(LatencyTrend, PhasesAndJitterAreNone) {
  LatencyTrend phases(0, us(0.1));
  for (std::size_t frame = 0; frame < 40; ++frame)
    EXPECT_FALSE(phases.add(frame, us(100.0 + 0.01 * static_cast<double>(frame))));
  EXPECT_TRUE(phases.settled());
  std::mt19937 random(1);
  LatencyTrend jitter(0, us(0.1));
  for (std::size_t frame = 0; frame < 400; ++frame)
    EXPECT_FALSE(jitter.add(frame, us(5000.0 + static_cast<double>(random() % 1000)))) << frame;
}

TEST(LatencyTrend, WhereChanceMovesEachLatencyAFewFramesSayNothing) {
  LatencyTrend chance(0, us(0.1), LatencyTrend::kByChance);
  for (const double latency : {5000.0, 5200.0, 5900.0}) chance.add(0, us(latency));
  EXPECT_FALSE(chance.known());
  std::mt19937 random(2);
  for (std::size_t frame = 0; frame < 4000; ++frame) {
    EXPECT_FALSE(chance.add(frame, us(5000.0 + static_cast<double>(random() % 1000)))) << frame;
    EXPECT_EQ(chance.settled(), chance.known());
  }
  for (std::size_t frame = 0; frame < 24; ++frame)
    chance.add(frame, us(6000.0 + 67.0 * static_cast<double>(frame)));
  EXPECT_FALSE(chance.settled());
  EXPECT_NEAR(chance.slope(), 67e-6, 1e-9);
}

// Each block goes up and down, but they lie higher and higher.
TEST(LatencyTrend, ADriftBelowTheNoiseOfABlockShowsInHalves) {
  LatencyTrend trend(0, us(0.1));
  for (std::size_t frame = 0; frame < 96; ++frame)
    EXPECT_FALSE(trend.add(frame, us(5000.0 + (frame % 2 == 0 ? 30 : 0) + 0.5 * static_cast<double>(frame))));
  EXPECT_FALSE(trend.settled());
  EXPECT_NEAR(trend.slope(), 0.5e-6, 1e-8);
}

// However many frames there are: their means are kept in ever longer blocks.
TEST(LatencyTrend, ALongRunShowsItToo) {
  LatencyTrend trend(0, us(0.1));
  for (std::size_t frame = 0; frame < 10'000; ++frame)
    trend.add(frame, us(5000.0 + (frame % 2 == 0 ? 30 : 0) + 0.01 * static_cast<double>(frame)));
  EXPECT_FALSE(trend.settled());
  EXPECT_NEAR(trend.slope(), 0.01e-6, 1e-9);
}

TEST(LatencyTrend, NoiseIsNoDrift) {
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    LatencyTrend trend(0, us(0.1));
    for (std::size_t frame = 0; frame < 96; ++frame)
      trend.add(frame, us(5000.0 + static_cast<double>(random() % 50)));
    EXPECT_TRUE(trend.settled()) << seed;
  }
}

}  // namespace latency_trend_test
}  // namespace parallax::test
