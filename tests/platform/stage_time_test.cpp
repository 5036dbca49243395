// SPDX-License-Identifier: Apache-2.0
// Where a stage's cycles went: whole cycles, and shares that sum to 100.0 %.
#include "platform/results/stage_time.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numeric>

#include "tests/cli/program.hpp"

namespace parallax {
namespace stage_time_test {

using Parts = std::vector<std::int64_t>;

TEST(Shares, AreRoundedByTheLargestRemainder) {
  EXPECT_EQ(shares_in_tenths({1, 1, 1}), (Parts{334, 333, 333}));
  EXPECT_EQ(shares_in_tenths({2, 1}), (Parts{667, 333}));
  EXPECT_EQ(shares_in_tenths({0, 7, 0}), (Parts{0, 1000, 0}));
  EXPECT_EQ(shares_in_tenths({9994, 3, 3, 0}), (Parts{1000, 0, 0, 0}));
  EXPECT_EQ(shares_in_tenths({9988, 6, 6}), (Parts{999, 1, 0}));
  EXPECT_EQ(shares_in_tenths({0, 0}), (Parts{0, 0}));
  EXPECT_EQ(shares_in_tenths({}), Parts{});
  EXPECT_EQ(shares_in_tenths({4'000'000'000'000'000, 4'000'000'000'000'000}), (Parts{500, 500}));
}

RC_GTEST_PROP(Shares, SumToTheWholeAndLieWithinATenth, ()) {
  const auto parts = *rc::gen::container<Parts>(5, rc::gen::inRange<std::int64_t>(0, 1'000'000'000'000));
  const std::int64_t sum = std::accumulate(parts.begin(), parts.end(), std::int64_t{0});
  RC_PRE(sum > 0);
  const Parts shares = shares_in_tenths(parts);
  RC_ASSERT(std::accumulate(shares.begin(), shares.end(), std::int64_t{0}) == 1000);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    RC_ASSERT(shares[i] >= 0);
    RC_ASSERT(std::abs(shares[i] * sum - parts[i] * 1000) < sum);
  }
}

class StageReport : public ::testing::TestWithParam<const char*> {
 protected:
  nlohmann::json run(const std::string& arguments) const {
    const test::Outcome outcome = program_("run --timing-only -q --json -d 32 " + arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out, nullptr, false);
  }

  test::Program program_;
};

TEST_P(StageReport, CyclesSumToTheWindowAndSharesToAHundred) {
  const nlohmann::json tree = run(GetParam());
  for (const auto& [name, stage] : tree["stages"].items()) {
    SCOPED_TRACE(name);
    std::int64_t cycles = 0, tenths = 0;
    for (const char* part : {"busy", "starved", "blocked", "memory", "synchroniser", "blanking"}) {
      ASSERT_TRUE(stage[part]["value"].is_number_integer());
      const std::int64_t value = stage[part]["value"];
      EXPECT_GE(value, 0) << part;
      cycles += value;
      const double share = stage[std::string(part) + "_share"]["value"];
      EXPECT_EQ(share, std::round(share * 10) / 10) << part;
      tenths += std::llround(share * 10);
    }
    EXPECT_GT(cycles, 0);
    EXPECT_EQ(cycles, stage["window"]["value"]);
    EXPECT_EQ(tenths, 1000);
  }
  for (const auto& [name, stream] : tree["streams"].items()) {
    SCOPED_TRACE(name);
    const double full = stream["full"]["value"], empty = stream["empty"]["value"];
    EXPECT_GE(full, 0);
    EXPECT_GE(empty, 0);
    EXPECT_LE(full + empty, 100.0 + 1e-9);
    const double depth = stream["depth"]["value"], largest = stream["high_water"]["value"];
    EXPECT_LE(stream["mean_occupancy"]["value"], largest);
    EXPECT_LE(largest, depth);
    // The histogram ends at the level that occurred last, and tells the same.
    const auto bins = stream["occupancy"]["value"].get<std::vector<std::int64_t>>();
    const std::int64_t bin = stream["occupancy_bin"]["value"];
    ASSERT_FALSE(bins.empty());
    EXPECT_EQ(static_cast<std::int64_t>(bins.size()) - 1,
              stream["high_water"]["value"].get<std::int64_t>() / bin);
    if (bin == 1) {
      double cycles = 0, tokens = 0;
      for (std::size_t level = 0; level < bins.size(); ++level) {
        cycles += static_cast<double>(bins[level]);
        tokens += static_cast<double>(bins[level]) * static_cast<double>(level);
      }
      EXPECT_NEAR(stream["mean_occupancy"]["value"], tokens / cycles, 1e-9);
      EXPECT_NEAR(empty, 100.0 * static_cast<double>(bins[0]) / cycles, 1e-9);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, StageReport,
    ::testing::Values(
        "--size 160x128", "--size 64x48 --timing-frames 1", "--size 64x48 --timing-frames 2",
        "--size 96x64 --set memory.model=bus --set memory.bytes_per_cycle=1 --set clocks.memory_hz=20e6",
        "--size 96x64 --set link.host_pixel_rate=0 --set rectification.row_overhead=20"));

TEST_F(StageReport, SlowMemoryShowsAsWaitingForMemoryAndOverheadAsBlanking) {
  const auto share = [](const nlohmann::json& tree, const char* stage, const char* part) {
    return tree["stages"][stage][part]["value"].get<double>();
  };
  const nlohmann::json slow =
      run("--size 96x64 --set memory.model=bus --set memory.bytes_per_cycle=1 --set clocks.memory_hz=20e6");
  EXPECT_GT(share(slow, "unpack_left", "memory_share"), 10);
  const nlohmann::json idle =
      run("--size 96x64 --set link.host_pixel_rate=0 --set census.row_overhead=1000 "
          "--set software.queue_frames=true");
  EXPECT_GT(share(idle, "census", "blanking_share"), 50);
  EXPECT_EQ(share(idle, "census", "memory_share"), 0);
}

TEST_F(StageReport, VerbosePrintsALineForEachStageAndStream) {
  const test::Outcome outcome = program_("run --timing-only -v -d 32 --size 64x48");
  const nlohmann::json tree = run("--size 64x48");
  std::size_t stages = 0, streams = 0;
  for (const std::string& line : test::lines(outcome.out)) {
    stages += line.rfind("stage  ", 0) == 0 ? 1U : 0U;
    streams += line.rfind("stream ", 0) == 0 ? 1U : 0U;
  }
  EXPECT_EQ(stages, tree["stages"].size()) << outcome.out;
  EXPECT_EQ(streams, tree["streams"].size()) << outcome.out;
}

}  // namespace stage_time_test
}  // namespace parallax
