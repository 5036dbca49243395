// SPDX-License-Identifier: Apache-2.0
// How much of a whole machine's motion leaps find, whatever its memory does: no date depends on it, but the
// time that a run takes does.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "tests/timing/in_child.hpp"
#include "tests/timing/machine_bench.hpp"

namespace parallax::test {
namespace leap_share_test {

// Hundredths of all firings that leaps go over, timing only, or a line that says why there are none.
std::string leaped(int width, int height, const std::vector<std::string>& assignments) {
  return in_child([&] {
    const MachineConfig config = preset(assignments);
    const EncodedMap map = map_of_size(width, height, config.rectification.range, 1.0);
    MachineInput input;
    input.width = width;
    input.height = height;
    input.map = &map;
    input.frames = 4;
    input.expose = [](std::int64_t) { return StereoFrame{}; };
    const Machine machine("machine", config, input);
    sc_core::sc_start();
    if (!machine.finished()) return "stuck:\n" + describe(machine.dataflow().waits());
    std::uint64_t firings = 0;
    for (const Stage* stage : machine.dataflow().stages()) firings += stage->statistics().firings;
    return std::to_string(100 * machine.dataflow().leaped_firings() / firings);
  });
}

struct Case {
  int width, height;
  std::vector<std::string> assignments;
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << fmt::format("{}x{} {}", c.width, c.height, fmt::join(c.assignments, " "));
}

class LeapShare : public ::testing::TestWithParam<Case> {};

TEST_P(LeapShare, IsNearlyAll) {
  const std::string share = leaped(GetParam().width, GetParam().height, GetParam().assignments);
  ASSERT_EQ(share.find_first_not_of("0123456789"), std::string::npos) << share;
  EXPECT_GE(std::stoi(share), 97);
}

// Where answers come soon, motion ends and has to be found again most often.
INSTANTIATE_TEST_SUITE_P(
    OfMachines, LeapShare,
    ::testing::Values(Case{640, 480, {"matching.iterations=4"}}, Case{320, 240, {"matching.iterations=2"}},
                      Case{800, 608, {"matching.iterations=8"}},
                      Case{416, 304, {"matching.iterations=3", "memory.latency_ns=10"}},
                      Case{640, 480, {"matching.iterations=4", "memory.latency_ns=0"}},
                      Case{640, 480, {"matching.iterations=4", "dram.clock_period_ps=3750"}},
                      Case{640, 480, {"matching.iterations=4", "dma.left.outstanding=1"}}));

}  // namespace leap_share_test
}  // namespace parallax::test
