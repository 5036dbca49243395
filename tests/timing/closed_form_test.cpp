// SPDX-License-Identifier: Apache-2.0
// Latency and frame period of the whole machine against formulas in what the stages declare.
#include <gtest/gtest.h>

#include <sstream>

#include "tests/timing/in_child.hpp"
#include "tests/timing/machine_bench.hpp"

namespace parallax::test {
namespace {

enum class Period { kEqual, kAtLeast };

// Look-ahead of each stage in pixels.
struct LookAhead {
  explicit LookAhead(const MachineConfig& c, int width, int height) {
    const auto pixels = [&](const auto& kernel) {
      return std::min<std::int64_t>(
          std::int64_t{kernel.look_ahead_rows()} * width + kernel.look_ahead_pixels(),
          std::int64_t{width} * height);
    };
    rectification = pixels(Rectification(c.rectification, width, height));
    census = pixels(Census(c.census, width, height));
    consistency = pixels(Consistency(c.consistency, c.matching.range(), width, height));
    texture = pixels(Texture(c.texture, width, height));
    speckle = pixels(Speckle(c.speckle, width, height));
    gap = pixels(GapInterpolation(c.gap_interpolation, width, height));
    noise = pixels(NoiseReduction(c.noise_reduction, width, height));
  }
  std::int64_t rectification, census, consistency, texture, speckle, gap, noise;
};

struct Expected {
  std::int64_t first, last, period;
};

// All stages run at an interval of 1 without overheads, all FIFOs are registered (+1 from writing to
// reading), and the matcher takes n cycles a pixel. Cycle 0 is the first edge at which the frame is complete
// in memory.
//
//   0      the three engines request their first bursts; answers come within the cycle
//   1      bursts written; 2: read, cut, and the first tokens written
//   3      rectification reads pixel 0; it writes pixel 0 when it has read pixel R, its look-ahead, and R
//   more
//          after that
//   m_0 =  3 + R + latency + 1 + C + latency + 1: the matcher reads pixel 0, after the census looked C ahead
//   m_k =  m_0 + k n: nothing before the matcher is slower than it
//
// From there a disparity passes the stages at latency + 1 each. A look-ahead of L pixels adds L n cycles to
// the first disparity, since it waits for pixel L of the matcher, and L cycles to the last one, since there
// is nothing to wait for any more.
//
// A frame follows the one before after the busy time of the busiest stage, unless a stage near the input has
// to fill its window before it can go on. It ended the frame before as early as what lies between it and the
// matcher could hold: d tokens in each FIFO, the latency of each stage, and the census's look-ahead. From the
// dates
//   census writes its last pixel into a full FIFO: its firing was at m_(N-1-d-c) + 1, c its latency;
//   rectification likewise: m_(N-1-C-2d-c-r) + 2, r its latency;
// the next frame's pixel 0 takes the way above.
Expected expected(const MachineConfig& config, int width, int height, std::int64_t busiest_stage) {
  const LookAhead ahead(config, width, height);
  const PipelineTiming& t = config.timing;
  const std::int64_t n = config.matching.iterations;
  const std::int64_t pixels = std::int64_t{width} * height;
  const std::int64_t d = config.streams.default_depth;
  const std::int64_t r = t.rectification.latency;
  const std::int64_t c = t.census.latency;

  const std::int64_t fill = ahead.rectification + r + 1 + ahead.census + c + 1;
  const std::int64_t m_0 = 3 + fill;
  const std::int64_t behind = (n - 1) + t.matching.latency + 1 + t.subpixel.latency + 1 +
                              t.uniqueness.latency + 1 + t.consistency.latency + 1 + t.texture.latency + 1 +
                              t.speckle.latency + 1 + t.gap_interpolation.latency + 1 +
                              t.noise_reduction.latency;
  const std::int64_t held = ahead.consistency + ahead.speckle + ahead.gap + ahead.noise;
  Expected e{};
  e.first = m_0 + held * n + behind;
  e.last = m_0 + (pixels - 1) * n + behind + held;
  const std::int64_t census_refill = (pixels - 1 - d - c) * n + 1 + 1 + ahead.census + c + 1;
  const std::int64_t rectification_refill = (pixels - 1 - ahead.census - 2 * d - c - r) * n + 2 + 1 + fill;
  e.period = std::max({busiest_stage, census_refill, rectification_refill});
  return e;
}

std::string compare(const MachineConfig& given, int width, int height, Period period = Period::kEqual) {
  return in_child([&] {
    constexpr std::int64_t kFrames = 6;
    const EncodedMap map = encode(identity_map(width, height, given.rectification.range));
    MachineInput input;
    input.width = width;
    input.height = height;
    input.map = &map;
    input.frames = kFrames;
    input.expose = [](std::int64_t) { return StereoFrame{}; };
    const Machine machine("machine", pipeline_alone(given), input);
    sc_core::sc_start();
    if (!machine.finished()) return "stuck:\n" + describe(machine.dataflow().waits());
    std::uint64_t busiest = 0;
    for (const StageInfo& info : machine.pipeline().stages()) {
      busiest = std::max(busiest, info.stage->schedule().cycles());
    }
    const Expected e = expected(machine.config(), width, height, static_cast<std::int64_t>(busiest));
    const std::int64_t begin = machine.core_clock().cycle_at_or_after(machine.times()[0].in_memory).count();
    const std::vector<FrameDates>& filtered = machine.pipeline().last_filter().frames();
    const std::vector<FrameDates>& matched = machine.pipeline().matcher().frames();
    std::ostringstream out;
    const auto check = [&](const char* what, std::int64_t want, Cycles have) {
      if (have.count() != want) out << what << ": expected " << want << ", have " << have.count() << "\n";
    };
    check("first", e.first, filtered[0].first_write - Cycles(begin));
    check("last", e.last, filtered[0].last_write - Cycles(begin));
    const Cycles steady = matched[kFrames - 1].first_firing - matched[kFrames - 2].first_firing;
    if (period == Period::kEqual || steady < Cycles(e.period)) check("period", e.period, steady);
    return out.str();
  });
}

struct Size {
  int width, height;
};

// With two cycles a pixel it is the filters' windows and the image that waits for them that hold up the next
// frame, on which there is no formula here: the period is no shorter than the one of the formula.
TEST(ClosedForm, TheMachineOfThePaperAtSmallSizes) {
  for (const Size size : {Size{96, 96}, Size{160, 120}}) {
    for (const int n : {1, 2, 4}) {
      const MachineConfig config =
          preset({"matching.iterations=" + std::to_string(n), "rectification.window=9"});
      EXPECT_EQ(compare(config, size.width, size.height, n == 2 ? Period::kAtLeast : Period::kEqual), "")
          << size.width << " x " << size.height << ", " << n << " iterations";
    }
  }
}

TEST(ClosedForm, OtherWindowsLatenciesAndDepths) {
  const auto check = [](const std::vector<std::string>& assignments, Period period) {
    EXPECT_EQ(compare(preset(assignments), 128, 96, period), "") << assignments[0] << " " << assignments[1];
  };
  check({"rectification.window=3", "census.window_height=1", "texture.window=3"}, Period::kEqual);
  check({"rectification.window=31", "streams.default_depth=4"}, Period::kEqual);
  check({"rectification.window=15", "matching.latency=0", "census.latency=17", "rectification.latency=1"},
        Period::kEqual);
  check({"rectification.window=5", "speckle.iterations=0", "gap_interpolation.enabled=false"},
        Period::kEqual);
  check({"rectification.window=5", "consistency.enabled=false", "census.window_height=7"}, Period::kAtLeast);
}

TEST(ClosedForm, TheMachineOfThePaperAtVga) { EXPECT_EQ(compare(preset(), 640, 480), ""); }

}  // namespace
}  // namespace parallax::test
