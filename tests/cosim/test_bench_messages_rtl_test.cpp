// SPDX-License-Identifier: Apache-2.0
// What the vectors' test bench says of each handshake that a circuit breaks, in Icarus Verilog.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tests/cli/program.hpp"

namespace parallax::test {
namespace test_bench_messages_rtl_test {

constexpr const char* kPass = "PASS noise_reduction: 512 tokens of smoothed, in ";

class BrokenHandshake : public ::testing::Test {
 protected:
  // Of equal neighbours the mean is the pixel itself: what comes in goes out.
  void SetUp() override {
    ASSERT_EQ(program_("vectors --stage noise_reduction --size 32x16 -s noise_reduction.max_difference=0 "
                       "--out v -q")
                  .code,
              0);
  }

  /// What the test bench says of a circuit that hands its tokens on, but for these assignments.
  std::string said(const std::string& ready, const std::string& valid, const std::string& data,
                   int exit_code) {
    program_.folder().write(
        "v/noise_reduction.sv",
        fmt::format(
            "module noise_reduction(input clk, rst, input [11:0] in_disparity_data, input "
            "in_disparity_valid, in_disparity_first, in_disparity_last, output in_disparity_ready,\n"
            "  output [11:0] out_disparity_data, output out_disparity_valid, input out_disparity_ready);\n"
            "  reg [31:0] cycle = 0, tokens = 0;\n"
            "  always @(posedge clk) begin\n"
            "    cycle <= cycle + 1;\n"
            "    if (!rst && out_disparity_valid === 1 && out_disparity_ready) tokens <= tokens + 1;\n"
            "  end\n"
            "  assign in_disparity_ready = {};\n  assign out_disparity_valid = {};\n"
            "  assign out_disparity_data = {};\nendmodule\n",
            ready, valid, data));
    const std::string command = fmt::format(
        "cd '{}' && iverilog -g2012 -o sim noise_reduction_tb.sv noise_reduction.sv && vvp sim > said 2>&1",
        (program_ / "v").string());
    const int status = std::system(command.c_str());
    EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, exit_code);
    return program_.read("v/said");
  }
  static bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }

  const Program program_;
};

constexpr const char* kReady = "out_disparity_ready";
constexpr const char* kValid = "in_disparity_valid";
constexpr const char* kData = "in_disparity_data";

TEST_F(BrokenHandshake, IsNoneOfACircuitThatIsRight) {
  EXPECT_TRUE(has(said(kReady, kValid, kData, 0), kPass)) << said(kReady, kValid, kData, 0);
}

TEST_F(BrokenHandshake, UnknownReadyOrValidIsNamedWithItsCycle) {
  const std::string ready = said("cycle == 100 ? 1'bx : out_disparity_ready", kValid, kData, 1);
  EXPECT_TRUE(has(ready, "in_disparity_ready is unknown in cycle 100\n")) << ready;
  const std::string valid = said(kReady, "cycle == 100 ? 1'bx : in_disparity_valid", kData, 1);
  EXPECT_TRUE(has(valid, "out_disparity_valid is unknown in cycle 100\n")) << valid;
}

TEST_F(BrokenHandshake, DataThatChangeAreNamed) {
  const std::string text =
      said(kReady, kValid, "in_disparity_data ^ {11'd0, !out_disparity_ready && cycle[0]}", 1);
  EXPECT_TRUE(has(text, "out_disparity_data changes in cycle ")) << text;
  EXPECT_TRUE(has(text, ", before the token was taken\n")) << text;
}

TEST_F(BrokenHandshake, ATokenTooManyIsNamed) {
  const std::string text = said(kReady, "in_disparity_valid || tokens == 512", kData, 1);
  EXPECT_TRUE(has(text, "smoothed: more than 512 tokens come out, in cycle ")) << text;
  EXPECT_TRUE(has(text, "smoothed: 513 tokens came out, expected 512\n")) << text;
}

// Ten lines of them, and no endless run.
TEST_F(BrokenHandshake, AThousandOfThemAreEnough) {
  const std::string text = said(kReady, "1'bx", kData, 1);
  EXPECT_TRUE(has(text, "FAIL noise_reduction: the handshake was broken 1000 times, in cycle ")) << text;
  std::size_t lines = 0;
  for (std::size_t at = 0; (at = text.find(" is unknown in cycle ", at)) != std::string::npos; ++at) ++lines;
  EXPECT_EQ(lines, 10U) << text;
}

}  // namespace test_bench_messages_rtl_test
}  // namespace parallax::test
