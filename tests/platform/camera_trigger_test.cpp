// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/camera_trigger.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace parallax {
namespace camera_trigger_test {

TEST(CameraTrigger, DoesNotDriftOverAMillionFrames) {
  CameraConfig config;
  config.frame_rate = 29.97;
  const CameraTrigger trigger(config, Hertz(100'000'000));
  for (const std::int64_t k :
       {std::int64_t{0}, std::int64_t{1}, std::int64_t{999'999}, std::int64_t{1'000'000}}) {
    EXPECT_EQ(trigger.exposed(k).count(), k * 10'000'000'000 / 2997) << k;
  }
}

TEST(CameraTrigger, JitterDelaysUpToItsBoundAndFollowsTheSeed) {
  CameraConfig config;
  config.frame_rate = 100;
  config.jitter_ns = 50;
  const CameraTrigger trigger(config, Hertz(100'000'000));
  const CameraTrigger again(config, Hertz(100'000'000));
  config.jitter_seed = 2;
  const CameraTrigger other(config, Hertz(100'000'000));
  std::int64_t least = 5, most = 0, different = 0;
  for (std::int64_t k = 0; k < 1000; ++k) {
    const std::int64_t late = trigger.exposed(k).count() - k * 1'000'000;
    least = std::min(least, late);
    most = std::max(most, late);
    EXPECT_EQ(again.exposed(k), trigger.exposed(k));
    different += other.exposed(k) == trigger.exposed(k) ? 0 : 1;
  }
  EXPECT_EQ(least, 0);
  EXPECT_EQ(most, 5);
  EXPECT_GT(different, 500);
}

}  // namespace camera_trigger_test
}  // namespace parallax
