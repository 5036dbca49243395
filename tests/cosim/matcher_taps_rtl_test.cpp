// SPDX-License-Identifier: Apache-2.0
// One path unit inside the reference circuit of the matcher, from the waves of its test bench, beside the tap
// of that path: equal as it is, and with a fault different exactly where a naive path with that fault is.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/markdown.hpp"
#include "tests/cli/program.hpp"
#include "tests/paths.hpp"

namespace parallax::test {
namespace matcher_taps_rtl_test {

constexpr int kWidth = 32, kHeight = 16, kGroup = 8, kGroups = 4, kDisparities = kGroup * kGroups;
constexpr int kP1 = 8, kP2 = 42, kCostBits = 6, kPathMask = 511;

// Of pixel (x, y) and disparity d.
using Costs = std::vector<int>;
std::size_t at(int x, int y, int d) { return static_cast<std::size_t>((y * kWidth + x) * kDisparities + d); }

Costs costs_of(const std::string& memh) {
  Costs costs;
  for (const std::string& line : lines(memh)) {
    const std::uint64_t word = std::stoull(line, nullptr, 16);
    for (int i = 0; i < kGroup; ++i)
      costs.push_back(static_cast<int>(word >> (i * kCostBits) & ((1u << kCostBits) - 1)));
  }
  return costs;
}

// The path from the north-west, as wide as the circuit has it. With the fault, the highest disparity has a
// neighbour above it: what lies behind it in the delay line, disparity 0 of the pixel after the predecessor.
Costs north_west(const Costs& costs, bool with_fault) {
  Costs path(costs.size());
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      for (int d = 0; d < kDisparities; ++d) {
        path[at(x, y, d)] = costs[at(x, y, d)];
        if (x == 0 || y == 0) continue;
        const int* const before = &path[at(x - 1, y - 1, 0)];
        const int lowest = *std::min_element(before, before + kDisparities);
        int best = std::min(before[d], lowest + kP2);
        if (d > 0) best = std::min(best, before[d - 1] + kP1);
        if (d + 1 < kDisparities) {
          best = std::min(best, before[d + 1] + kP1);
        } else if (with_fault) {
          best = std::min(best, path[at(x, y - 1, 0)] + kP1);
        }
        path[at(x, y, d)] = (path[at(x, y, d)] + best - lowest) & kPathMask;
      }
    }
  }
  return path;
}

class MatcherTaps : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(program_(fmt::format("vectors --stage matching --taps --size {}x{} -s matching.parallelism={} "
                                   "-s matching.iterations={} --out v -q",
                                   kWidth, kHeight, kGroup, kGroups))
                  .code,
              0);
  }

  /// Exit code of the test bench, which prefers what lies beside it to the reference circuits.
  int simulate() const {
    const std::string command = fmt::format(
        "cd '{}/v' && iverilog -g2012 -s matching_tb -y . -y '{}' -Y .sv -D'DUT=matching #(.WIDTH({}), "
        ".HEIGHT({}), .P({}), .ITERATIONS({}))' -o sim matching_tb.sv && vvp sim +vcd > said 2>&1",
        program_.folder().path().string(), source_path("modules/rtl"), kWidth, kHeight, kGroup, kGroups);
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  Outcome compare_path(const std::string& options = "") const {
    return program_(
        "compare --vectors v --dump path_nw=v/matching.vcd --signals path_nw.data=path_north_west.path_costs,"
        "path_nw.valid=path_north_west.step,path_nw.clock=clk " +
        options);
  }

  const Program program_;
};

TEST_F(MatcherTaps, AreTheCostsOfThePathUnit) {
  EXPECT_EQ(simulate(), 0) << program_.read("v/said");
  const Outcome outcome = compare_path();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "path_nw: equal, 2048 tokens\n");
}

TEST_F(MatcherTaps, SayWhereAPathUnitGoesWrong) {
  std::string unit = read_text(source_path("modules/rtl/path_unit.sv"));
  const std::string right = "has_above = !last_group";
  ASSERT_NE(unit.find(right), std::string::npos);
  program_.folder().write("v/path_unit.sv", unit.replace(unit.find(right), right.size(), "has_above = 1'b1"));
  EXPECT_EQ(simulate(), 1) << program_.read("v/said");

  const Costs costs = costs_of(program_.read("v/pixel_costs.memh"));
  ASSERT_EQ(costs.size(), static_cast<std::size_t>(kWidth * kHeight * kDisparities));
  const Costs expected = north_west(costs, false), got = north_west(costs, true);
  std::size_t different = 0;
  while (expected[different] == got[different]) ++different;
  std::size_t values = 0;
  for (std::size_t i = 0; i < costs.size(); ++i) values += expected[i] != got[i] ? 1 : 0;
  const std::size_t pixel = different / kDisparities;

  const nlohmann::json tree = nlohmann::json::parse(compare_path("--json").out);
  const nlohmann::json& first = tree.at("first_difference");
  EXPECT_EQ(first.at("row"), pixel / kWidth);
  EXPECT_EQ(first.at("column"), pixel % kWidth);
  EXPECT_EQ(first.at("disparity"), kDisparities - 1);
  EXPECT_EQ(first.at("disparity"), different % kDisparities);
  EXPECT_EQ(first.at("expected"), std::to_string(expected[different]));
  EXPECT_EQ(first.at("got"), std::to_string(got[different]));
  EXPECT_EQ(tree.at("streams").at(0).at("different_values"), values);
  EXPECT_EQ(
      tree.at("streams").at(0).at("patterns").at(0).at("text"),
      "path nw: it goes wrong at disparity 31, from row 1 on; all else that differs lies behind a pixel "
      "that does");
}

}  // namespace matcher_taps_rtl_test
}  // namespace parallax::test
