// SPDX-License-Identifier: Apache-2.0
// The paper's budgets at 640 x 480, timing only, with the preset as it is and a map of one byte a pixel and
// image.
#include <gtest/gtest.h>

#include "tests/timing/machine_bench.hpp"

namespace parallax::test {
namespace budget_test {

// Frames a second that the host receives, once the machine is full.
double frame_rate(const std::vector<std::string>& assignments) {
  constexpr int kWidth = 640;
  constexpr int kHeight = 480;
  const MachineConfig config = preset(assignments);
  const EncodedMap map = map_of_size(kWidth, kHeight, config.rectification.range, 1.0);
  EXPECT_NEAR(map.bytes_per_pixel(), 1.0, 0.1);
  MachineInput input;
  input.width = kWidth;
  input.height = kHeight;
  input.map = &map;
  input.frames = 4;
  input.expose = [](std::int64_t) { return StereoFrame{}; };
  const Machine machine("machine", config, input);
  sc_core::sc_start();
  EXPECT_TRUE(machine.finished()) << describe(machine.dataflow().waits());
  return 2.0 / (machine.times()[3].at_host - machine.times()[1].at_host).to_seconds();
}

// Published rates are what a computer receives, rounded down: predicted ones lie up to 7 % above.
TEST(Budget, Disparities128) {
  const double fps = frame_rate({"matching.iterations=4"});
  EXPECT_GE(fps, 100.0);
  EXPECT_LE(fps, 107.0);
  EXPECT_GE(fps * 640 * 480, 30e6);
}

TEST(Budget, Disparities256) {
  const double fps = frame_rate({"matching.iterations=8"});
  EXPECT_GE(fps, 70.0);
  EXPECT_LE(fps, 74.9);
  EXPECT_GE(fps * 640 * 480, 20e6);
  EXPECT_GE(fps * 640 * 480 * 256, 5.1e9);
}

}  // namespace budget_test
}  // namespace parallax::test
