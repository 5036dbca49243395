// SPDX-License-Identifier: Apache-2.0
// What must hold for the whole machine, whatever its clocks, rates, depths and buffers.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <sstream>
#include <variant>

#include "platform/results/run_metrics.hpp"
#include "platform/results/stage_time.hpp"
#include "tests/timing/random_machine.hpp"

namespace parallax::test {
namespace machine_invariants_test {

using Json = nlohmann::ordered_json;

// Percentages anywhere in the tree that are none.
std::string impossible(const Json& tree, const std::string& path) {
  std::string text;
  if (!tree.is_object()) return text;
  if (tree.contains("unit") && tree["unit"] == "%") {
    const double value = tree["value"];
    if (!(value >= 0 && value <= 100)) text += fmt::format("{} = {:.17g} %\n", path, value);
    return text;
  }
  for (const auto& [name, child] : tree.items()) text += impossible(child, path + "/" + name);
  return text;
}

// The six parts of a stage's time between two counts.
std::string check_parts(const std::string& what, const std::vector<std::int64_t>& parts, std::int64_t whole) {
  std::string text;
  std::int64_t sum = 0;
  for (const std::int64_t part : parts) {
    if (part < 0) text += what + ": a negative part\n";
    sum += part;
  }
  if (sum != whole) text += fmt::format("{}: parts sum to {}, not to {}\n", what, sum, whole);
  return text;
}

std::vector<std::int64_t> parts(const StageStatistics& s) {
  return {s.busy.count(),    s.blanking.count(), s.starved.count(),
          s.blocked.count(), s.memory.count(),   s.synchroniser.count()};
}

std::string check_shares(const Machine& machine, const MachineCase& c) {
  std::string text;
  const Json tree = to_json(measure(machine, {}, c.width, c.height));
  for (const StageInfo& info : machine.pipeline().stages()) {
    const std::string name = info.stage->basename();
    const KeptRecords<FrameDates>& frames = info.stage->frames();
    StageStatistics before;
    Cycles began(0);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const FrameDates& frame = frames[i];
      StageStatistics part = frame.before;
      part -= before;
      text += check_parts(name, parts(part), (frame.first_firing - began).count());
      before = frame.before;
      began = frame.first_firing;
    }
    StageStatistics rest = info.stage->statistics();
    rest -= before;
    text += check_parts(name + " since the last frame", parts(rest), rest.total().count());

    const Json& stage = tree["stages"][name];
    std::int64_t tenths = 0;
    std::vector<std::int64_t> cycles;
    for (const char* part : {"busy", "starved", "blocked", "memory", "synchroniser", "blanking"}) {
      cycles.push_back(stage[part]["value"]);
      tenths += std::llround(10 * stage[std::string(part) + "_share"]["value"].get<double>());
    }
    text += check_parts(name + " in the window", cycles, stage["window"]["value"]);
    if (tenths != 1000) text += fmt::format("{}: shares sum to {} tenths of a percent\n", name, tenths);
  }
  return text + impossible(tree, "");
}

RC_GTEST_PROP(MachineInvariants, SharesAreCompleteAndPossible, ()) {
  const MachineCase c = random_machine(*rc::gen::arbitrary<std::uint32_t>(), Contention::kAny);
  const std::string text = after_run(c, [&](const Machine& machine) { return check_shares(machine, c); });
  if (text != "") RC_FAIL(text + c.text());
}

// A memory that is always busy, for seven ports whose shares, added up as fractions, are more than 1.
TEST(MachineInvariants, ABusThatIsAlwaysTakenIsTakenFor100Percent) {
  MachineCase c = random_machine(906483134, Contention::kAny);
  c.others.insert(c.others.end(),
                  {"camera.format=mono8", "link.color_output=false", "matching.path_storage=on_chip",
                   "matching.paths=w,nw,n,ne", "camera.early_start_rows=0", "camera.fault=none",
                   "camera.skew_ns=0", "camera.exposure_ns=0", "link.early_start_rows=0"});
  EXPECT_EQ(after_run(c,
                      [&](const Machine& machine) {
                        return check_shares(machine, c) +
                               fmt::format("{}",
                                           measure(machine, {}, c.width, c.height).number("memory/share"));
                      }),
            "100");
}

// When each frame is at the host, in picoseconds.
std::vector<std::uint64_t> arrivals(const MachineCase& c) {
  std::istringstream in(after_run(c, [&c](const Machine& machine) {
    std::string text;
    for (std::size_t i = 0; i < static_cast<std::size_t>(c.frames); ++i) {
      text += fmt::format("{} ", machine.times()[i].at_host.value());
    }
    return text;
  }));
  std::vector<std::uint64_t> dates;
  for (std::uint64_t date = 0; in >> date;) dates.push_back(date);
  return dates;
}

// The first frame that a faster part delays.
std::string delayed(const MachineCase& slow, const std::string& key, std::int64_t factor) {
  MachineCase fast = slow;
  fast.speeds[key] *= factor;
  const std::vector<std::uint64_t> before = arrivals(slow);
  const std::vector<std::uint64_t> after = arrivals(fast);
  const auto frames = static_cast<std::size_t>(slow.frames);
  if (before.size() != frames || after.size() != frames) return "a run did not end\n" + slow.text();
  for (std::size_t i = 0; i < frames; ++i) {
    if (after[i] <= before[i]) continue;
    return fmt::format("{} times {}: frame {} at {} ps, not {} ps\n{}", key, factor, i, after[i], before[i],
                       slow.text());
  }
  return "";
}

std::string any_key(const MachineCase& c) {
  const auto keys = static_cast<std::uint32_t>(c.speeds.size());
  return std::next(c.speeds.begin(), *rc::gen::inRange(0u, keys))->first;
}

// No frame reaches the host later, so no rate is lower in the long run, where
//  - no port of the memory has to wait for another one: who is served first depends on who came first, so a
//  part
//    that is faster can take the turn of one that all wait for (as in real machines with such an arbiter);
//  - clocks are faster by whole factors: else an edge of the slow clock may lie just before one of the fast
//  clock,
//    and what arrives then is taken up later by the fast one.
RC_GTEST_PROP(MachineInvariants, AFasterPartDelaysNoFrame, ()) {
  MachineCase c = random_machine(*rc::gen::arbitrary<std::uint32_t>(), Contention::kNone);
  c.frames = 8;
  const std::string text = delayed(c, any_key(c), *rc::gen::inRange(2, 5));
  if (text != "") RC_FAIL(text);
}

// With contention nothing is certain (see above), but a faster memory has not been seen to delay a frame:
// this is measured on fixed machines, not a law.
TEST(MachineInvariants, AFasterMemoryDelaysNoFrameOfTheseMachines) {
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    MachineCase c = random_machine(seed, Contention::kAny);
    c.frames = 8;
    for (const char* key : {"clocks.memory_hz", "memory.bytes_per_cycle"}) {
      EXPECT_EQ(delayed(c, key, 1 + seed % 4 + 1), "");
    }
  }
}

}  // namespace machine_invariants_test
}  // namespace parallax::test
