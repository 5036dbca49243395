// SPDX-License-Identifier: Apache-2.0
// Cameras that send more than the machine takes lose frames in cycles: the steady state is whole ones.
#include "platform/machine/loss_cycles.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "platform/machine/frame_latencies.hpp"
#include "tests/cli/program.hpp"

namespace parallax::test {
namespace loss_cycles_test {

FrameTimes times(double due_ms, double latency_ms) {
  FrameTimes times;
  times.due = times.exposed = sc_core::sc_time(due_ms, sc_core::SC_MS);
  times.at_host = sc_core::sc_time(due_ms + latency_ms, sc_core::SC_MS);
  return times;
}

TEST(LossCycles, AreAsSureAsTheyEndAsTheyBegan) {
  LossCycles cycles;
  EXPECT_FALSE(cycles.any());
  EXPECT_EQ(cycles.whole(), 0u);
  cycles.begin(times(10, 2));
  EXPECT_TRUE(cycles.any());
  EXPECT_EQ(cycles.whole(), 0u);
  cycles.begin(times(110, 1));  // 99 ms later
  EXPECT_EQ(cycles.whole(), 1u);
  EXPECT_NEAR(cycles.uncertainty(), 1 / 99.0, 1e-9);
  cycles.begin(times(210, 2));
  EXPECT_EQ(cycles.whole(), 2u);
  EXPECT_EQ(cycles.uncertainty(), 0);
}

// Of cycles of four frames that take 1 to 4 ms, from frame 3 on.
TEST(FrameLatencies, OfWholeCyclesLeaveTheUnfinishedOneOut) {
  FrameLatencies latencies(0, 100);
  const auto exposure_to_host = static_cast<std::size_t>(
      std::find_if(frame_spans().begin(), frame_spans().end(),
                   [](const FrameSpan& span) { return std::string(span.name) == "exposure_to_host"; }) -
      frame_spans().begin());
  const auto mean = [&] { return latencies.steady(exposure_to_host).mean().to_seconds() * 1e3; };
  for (std::size_t frame = 0; frame < 30; ++frame) {
    if (frame == 3) latencies.begin_anew(frame, true);
    if (frame > 3 && frame % 4 == 3) latencies.begin_cycle(frame);
    latencies.add(frame,
                  times(10.0 * static_cast<double>(frame), 1.0 + static_cast<double>((frame + 1) % 4)));
    if (frame < 7) continue;
    EXPECT_TRUE(latencies.whole_cycles()) << frame;
    EXPECT_EQ(latencies.steady_end(), (frame + 1) / 4 * 4 - 1) << frame;
    EXPECT_NEAR(mean(), 2.5, 1e-9) << frame;
  }
  // What is longer than all whole ones is no part of a cycle any more.
  for (std::size_t frame = 30; frame < 60; ++frame)
    latencies.add(frame, times(10.0 * static_cast<double>(frame), 4));
  EXPECT_FALSE(latencies.whole_cycles());
  EXPECT_EQ(latencies.steady_end(), 59u);
  EXPECT_GT(mean(), 2.5);
}

// With one frame buffer the core has nothing to do between a frame that finds none and the next one, so that
// the rate is not the core's own. From the numbers of frames that two long runs drop, an independent measure.
TEST(LossRates, AreThoseOfWholeCycles) {
  const Program program;
  const auto run = [&program](const std::string& arguments) {
    const Outcome outcome = program("run --timing-only --no-verdict --json " + arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  };
  const auto rate = [](const nlohmann::json& tree) {
    return tree["performance"]["frame_rate"]["value"].get<double>();
  };
  const auto latency = [](const nlohmann::json& tree) {
    return tree["latency"]["exposure_to_host_mean"]["value"].get<double>();
  };
  const auto dropped = [](const nlohmann::json& tree) {
    return tree["camera"]["dropped_frames"]["value"].get<double>();
  };
  const std::string alone = "--preset core-alone --rectified --size 64x48 --set camera.frame_buffers=1 ";
  const std::string overlapping = alone + "--set pipeline.overlap_frames=true ";
  struct Case {
    std::string machine;
    double sent;
    double through = 0;  // of what is sent, where that is known
  };
  for (const Case& c :
       {Case{overlapping + "--set matching.iterations=8", 8000, 10 / 11.0},
        Case{alone + "--set matching.iterations=2", 29592.56},
        Case{overlapping + "--set matching.iterations=1 --set camera.early_start_rows=8", 61809.14},
        Case{"--size 128x64 --set software.queue_frames=true --set link.host_pixel_rate=0 --set "
             "camera.early_start_rows=8 --set link.output_buffers=1",
             1537.58}}) {
    const std::string at_rate = c.machine + fmt::format(" --set camera.frame_rate={} ", c.sent);
    const auto frames = [&](int number) { return run(at_rate + fmt::format("--timing-frames {}", number)); };
    const nlohmann::json once = frames(1000);
    const nlohmann::json twice = frames(3000);
    const double expected = c.sent * 2000 / (2000 + dropped(twice) - dropped(once));
    const nlohmann::json usual = run(at_rate);
    for (const nlohmann::json* tree : {&usual, &once, &twice}) {
      EXPECT_NEAR(rate(*tree) / expected, 1, 6e-4) << at_rate;
      EXPECT_EQ((*tree)["steady"]["established"]["value"], "yes") << at_rate;
      EXPECT_GE((*tree)["steady"]["loss_cycles"]["value"], 2) << at_rate;
      EXPECT_EQ((*tree)["steady"].count("drops_when_full"), 0u) << at_rate;
    }
    // It is no matter where in a cycle the run ends.
    EXPECT_NEAR(latency(usual) / latency(twice), 1, 2e-3) << at_rate;
    EXPECT_NEAR(rate(usual) / rate(twice), 1, 1e-4) << at_rate;
    if (c.through != 0) {
      EXPECT_NEAR(rate(usual), c.through * c.sent, 0.01);
    }
  }
}

// The host takes 325.5 frames a second: the first is lost after more frames than a run keeps the dates of,
// and the steady state begins there all the same.
TEST(LossRates, OfARunThatLosesNoneForLong) {
  const Program program;
  const Outcome outcome = program(
      "run --timing-only --no-verdict --json --disparities 32 --size 64x48 --set link.host_pixel_rate=1e6 "
      "--set camera.frame_rate=326.8 --timing-frames 5000");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json tree = nlohmann::json::parse(outcome.out);
  const nlohmann::json& rate = tree["performance"]["frame_rate"];
  const std::string window = rate["window"];
  EXPECT_GT(std::stoi(window.substr(window.find(' '))), 1100) << window;
  EXPECT_NEAR(rate["value"].get<double>(), 1e6 / 3072, 0.02);
  EXPECT_GE(tree["steady"]["loss_cycles"]["value"], 2);
  EXPECT_EQ(tree["steady"]["established"]["value"], "yes");
}

}  // namespace loss_cycles_test
}  // namespace parallax::test
