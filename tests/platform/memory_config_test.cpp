// SPDX-License-Identifier: Apache-2.0
#include "platform/config/memory_config.hpp"

#include <gtest/gtest.h>

namespace parallax {
namespace memory_config_test {

// 82 ns are 43.73 clocks of 1875 ps, and 98.4 of 833 1/3 ps.
TEST(MemoryConfig, LatencyInNsIsWholeCyclesOfTheMemory) {
  MemoryConfig config;
  config.latency_cycles = 0;
  config.latency_ns = 82;
  config.dram.clock_period_ps = 1875;
  EXPECT_EQ(config.dram_memory().latency, 44);
  config.dram.clock_period_ps = 833;
  EXPECT_EQ(config.dram_memory().latency, 99);
  config.dram.clock_period_ps = 2000;
  EXPECT_EQ(config.dram_memory().latency, 41);  // no more than it takes
  EXPECT_EQ(config.latency(ClockDomain("memory", Hertz(533'333'333))).count(), 44);
  EXPECT_EQ(config.latency(ClockDomain("memory", Hertz(1'000'000'000))).count(), 82);
  EXPECT_EQ(config.latency(ClockDomain("memory", Hertz(1))).count(), 1);
}

TEST(MemoryConfig, LatencyInCyclesComesOnTop) {
  MemoryConfig config;
  config.latency_cycles = 10;
  config.latency_ns = 0;
  config.dram.clock_period_ps = 1250;
  EXPECT_EQ(config.dram_memory().latency, 10);
  config.latency_ns = 5;
  EXPECT_EQ(config.dram_memory().latency, 14);
  EXPECT_EQ(config.latency(ClockDomain("memory", Hertz(800'000'000))).count(), 14);
}

}  // namespace memory_config_test
}  // namespace parallax
