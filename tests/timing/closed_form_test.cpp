// SPDX-License-Identifier: Apache-2.0
// Latency and frame period of the whole machine against formulas in what the stages declare.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <iostream>
#include <sstream>

#include "tests/timing/in_child.hpp"
#include "tests/timing/machine_bench.hpp"
#include "tests/timing/random_pipeline.hpp"

namespace parallax::test {
namespace closed_form_test {

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
  bool dates_hold;  // first and last are exact
  std::int64_t first, last;
  bool period_holds;  // period is exact; else it is a lower bound
  std::int64_t period;
};

std::int64_t depth(const Machine& machine, const std::string& stream) {
  for (const StreamBase* candidate : machine.dataflow().streams()) {
    if (candidate->basename() == stream) return candidate->depth();
  }
  throw std::logic_error("no stream " + stream);
}

// All stages but the matcher run at an interval of 1, none has overheads, all FIFOs are registered (+1 from
// writing to reading) and at least 2 deep, those that bridge a look-ahead as deep as Pipeline makes them, and
// the matcher takes n cycles a pixel. Cycle 0 is the first edge at which the frame is complete
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
// is nothing to wait for any more; where the look-aheads together are more than the frame, the first one does
// not wait for what is beyond it either. The texture filter looks ahead on the image alone. This holds where
// it does not look further than the disparities are behind the image anyway.
//
// A frame follows the one before after the busy time of the busiest stage, unless a stage near the input has
// to fill its window before it can go on. It ended the frame before as early as what lies between it and the
// matcher could hold: d tokens in each FIFO, the latency of each stage, and the census's look-ahead. From the
// dates
//   census writes its last pixel into a full FIFO: its firing was at m_(N-1-d-c) + 1, c its latency;
//   rectification likewise: m_(N-1-C-2d-c-r) + 2, r its latency;
// the next frame's pixel 0 takes the way above. This holds where the filters can flush between two frames:
// from the last disparity of one to the first of the next out of the consistency check, which looks A pixels
// ahead, it is period - n N + n + (n - 1) A cycles. A filter that needs longer holds up the matcher, and the
// period is longer than said here; with n = 1 the filter that needs longest is the busiest stage. And it
// holds where the image's own FIFOs take all that rectification is ahead by in that steady state.
Expected expected(const Machine& machine) {
  const MachineConfig& config = machine.config();
  const int width = machine.input().width;
  const int height = machine.input().height;
  const LookAhead ahead(config, width, height);
  const PipelineTiming& t = config.timing;
  const std::int64_t n = config.matching.iterations * t.matching.interval;
  const std::int64_t pixels = std::int64_t{width} * height;
  const std::int64_t d = config.streams.default_depth;
  const std::int64_t r = t.rectification.latency;
  const std::int64_t c = t.census.latency;

  const std::int64_t fill = ahead.rectification + r + 1 + ahead.census + c + 1;
  const std::int64_t m_0 = 3 + fill;
  const std::int64_t to_texture = (config.matching.iterations - 1) * t.matching.interval +
                                  t.matching.latency + 1 + t.subpixel.latency + 1 + t.uniqueness.latency + 1 +
                                  t.consistency.latency + 1;
  const std::int64_t behind = to_texture + t.texture.latency + 1 + t.speckle.latency + 1 +
                              t.gap_interpolation.latency + 1 + t.noise_reduction.latency;
  const std::int64_t held = ahead.consistency + ahead.speckle + ahead.gap + ahead.noise;
  Expected e{};
  e.dates_hold = ahead.texture <= ahead.census + ahead.consistency;
  e.first = m_0 + std::min(held, pixels - 1) * n + std::max<std::int64_t>(held - pixels + 1, 0) + behind;
  e.last = m_0 + (pixels - 1) * n + behind + held;
  const std::int64_t census_refill = (pixels - 1 - d - c) * n + 1 + 1 + ahead.census + c + 1;
  const std::int64_t rectification_refill = (pixels - 1 - ahead.census - 2 * d - c - r) * n + 2 + 1 + fill;
  e.period = std::max(census_refill, rectification_refill);
  for (const StageInfo& info : machine.pipeline().stages()) {
    e.period = std::max(e.period, static_cast<std::int64_t>(info.stage->schedule().cycles()));
  }

  const std::int64_t longest = std::max({ahead.texture, ahead.speckle, ahead.gap, ahead.noise});
  const std::int64_t pause = e.period - n * pixels + (n - 1) * ahead.consistency;
  const std::int64_t before_matcher = 2 * d + c + ahead.census;  // pixels, rectified and not matched
  const std::int64_t in_texture = before_matcher + ahead.consistency - ahead.texture + to_texture / n + 1;
  const std::int64_t in_output = before_matcher + held + (behind + 1) / n + 1;
  e.period_holds = e.dates_hold && t.matching.interval == 1 &&
                   (n == 1 || (longest <= pause && in_texture <= depth(machine, "left_texture") &&
                               in_output <= depth(machine, "left_output")));
  return e;
}

struct Compared {
  bool dates = false, period = false;  // for equality
  std::string differences;
};

// Compares with the formulas as far as they hold; `frames` enough for the motion to become periodic.
Compared compare(const MachineConfig& given, int width, int height, std::int64_t frames) {
  std::string text = in_child([&] {
    const EncodedMap map = encode(identity_map(width, height, given.rectification.range));
    MachineInput input;
    input.width = width;
    input.height = height;
    input.map = &map;
    input.frames = frames;
    input.expose = [](std::int64_t) { return StereoFrame{}; };
    const Machine machine("machine", pipeline_alone(given), input);
    sc_core::sc_start();
    if (!machine.finished()) return "00stuck:\n" + describe(machine.dataflow().waits());
    const Expected e = expected(machine);
    const std::int64_t begin = machine.core_clock().cycle_at_or_after(machine.times()[0].in_memory).count();
    const KeptRecords<FrameDates>& filtered = machine.pipeline().last_filter().stage->frames();
    std::ostringstream out;
    out << e.dates_hold << e.period_holds;
    const auto check = [&](const char* what, std::int64_t want, Cycles have) {
      if (have.count() != want) out << what << ": expected " << want << ", have " << have.count() << "\n";
    };
    if (e.dates_hold) {
      check("first", e.first, filtered[0].first_write - Cycles(begin));
      check("last", e.last, filtered[0].last_write - Cycles(begin));
    }
    const auto last = static_cast<std::size_t>(frames - 1);
    const Cycles steady = filtered[last].last_write - filtered[last - 1].last_write;
    if (e.period_holds || steady < Cycles(e.period)) check("period", e.period, steady);
    return out.str();
  });
  return {text[0] == '1', text[1] == '1', text.substr(2)};
}

TEST(ClosedForm, TheMachineOfThePaper) {
  const Compared vga = compare(preset(), 640, 480, 6);
  EXPECT_EQ(vga.differences, "");
  EXPECT_TRUE(vga.dates);
  EXPECT_TRUE(vga.period);
}

Compared compare_any() {
  const int width = number(8, 80);
  const int height = number(4, 40);
  std::vector<std::string> assignments;
  const auto draw = [&](const std::string& key, int low, int high, int step = 1) {
    assignments.push_back(fmt::format("{}={}", key, low + step * number(0, (high - low) / step)));
  };
  draw("matching.iterations", 1, 5);
  draw("matching.interval", 1, 2);
  draw("matching.parallelism", 1, 32);
  draw("rectification.window", 3, 15, 2);
  draw("census.window_height", 1, 7, 2);
  draw("texture.window", 3, 7, 2);
  draw("speckle.iterations", 0, 2);
  draw("gap_interpolation.l_max", 0, 10);
  draw("noise_reduction.window", 3, 7, 2);
  draw("streams.default_depth", 2, 32);
  for (const char* filter : {"consistency", "texture", "gap_interpolation", "noise_reduction"}) {
    if (number(0, 4) == 0) assignments.push_back(fmt::format("{}.enabled=false", filter));
  }
  for (const char* stage : {"rectification", "census", "matching", "subpixel", "uniqueness", "consistency",
                            "texture", "speckle", "gap_interpolation", "noise_reduction"}) {
    draw(fmt::format("{}.latency", stage), 0, 30);
  }
  const Compared found = compare(preset(assignments), width, height, 12);
  if (found.differences != "") {
    RC_FAIL(fmt::format("{} x {} {}\n{}", width, height, fmt::join(assignments, " "), found.differences));
  }
  return found;
}

TEST(ClosedForm, AnyMachine) {
  int all = 0;
  int dates = 0;
  int periods = 0;
  const auto result = rc::detail::checkTestable([&] {
    const Compared found = compare_any();
    ++all;
    dates += found.dates ? 1 : 0;
    periods += found.period ? 1 : 0;
  });
  std::ostringstream report;
  rc::detail::printResultMessage(result, report);
  std::cout << report.str() << "\nof " << all << " machines the formulas give the dates of " << dates
            << ", and the period of " << periods << "\n";
  ASSERT_TRUE(result.template is<rc::detail::SuccessResult>()) << report.str();
  if (all < 100) return;  // too few to tell
  EXPECT_GT(dates, all / 4);
  EXPECT_GT(periods, all / 12);
}

}  // namespace closed_form_test
}  // namespace parallax::test
