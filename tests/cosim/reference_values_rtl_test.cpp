// SPDX-License-Identifier: Apache-2.0
// The reference circuits (modules/rtl) in the test benches that parallax vectors writes: every value, under
// random stalls, over sizes and parameters.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <string>

#include "tests/cli/program.hpp"

namespace parallax::test {
namespace reference_values_rtl_test {

struct Circuit {
  const char* stage;
  std::string vectors;      // options of parallax vectors
  const char* parameters;   // of the circuit
  const char* module = "";  // where it has another name than the stage

  std::string dut() const { return fmt::format("-D'DUT={} #({})'", *module ? module : stage, parameters); }
};

struct Said {
  int code;
  std::string text;
};

Said shell(const Program& program, const std::string& command) {
  const std::string line = fmt::format("cd '{}' && {{ {}; }} >said 2>&1", (program / "v").string(), command);
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 1000, program.read("v/said")};
}

std::string written_vectors(const Program& program, const Circuit& circuit) {
  const Outcome vectors =
      program(fmt::format("vectors --stage {} {} --out v -q", circuit.stage, circuit.vectors));
  return vectors.code == 0 ? "" : vectors.err;
}

// What is wrong with the circuit; empty if it passes with all arguments.
std::string in_icarus(const Circuit& circuit, std::initializer_list<const char*> arguments) {
  const Program program;
  std::string found = written_vectors(program, circuit);
  const Said compiled =
      shell(program, fmt::format("iverilog -g2012 -Wall -s {0}_tb -y '{1}' -Y .sv {2} -o sim {0}_tb.sv",
                                 circuit.stage, source_path("modules/rtl"), circuit.dut()));
  if (compiled.code != 0 || !compiled.text.empty())
    found += compiled.text + "it does not compile, or warns\n";
  for (const char* const argument : arguments) {
    const Said ran = shell(program, fmt::format("vvp -n sim {}", argument));
    if (ran.code != 0 || ran.text.rfind("PASS ", 0) != 0) found += argument + (": " + ran.text);
  }
  return found;
}

std::string in_icarus(const Circuit& circuit) {
  return in_icarus(circuit, {"+seed=3", "+seed=4 +stall=128"});
}

constexpr const char* kSmall = "--size 64x32 -d 32 --frames 2";

TEST(ReferenceValuesRtl, Census) {
  EXPECT_EQ(in_icarus({"census", kSmall, ".WIDTH(64), .HEIGHT(32)"}), "");
  EXPECT_EQ(
      in_icarus({"census",
                 "--size 32x32 -d 32 -s census.window_width=3 -s census.window_height=7 -s census.latency=6 "
                 "-s census.interval=2",
                 ".WIDTH(32), .HEIGHT(32), .WINDOW_WIDTH(3), .WINDOW_HEIGHT(7), .LATENCY(6), .INTERVAL(2)"}),
      "");
  EXPECT_EQ(in_icarus({"census", "--size 32x16 -d 32 -s census.window_width=7 -s census.window_height=9",
                       ".WIDTH(32), .HEIGHT(16), .WINDOW_WIDTH(7), .WINDOW_HEIGHT(9)"}),
            "");
}

TEST(ReferenceValuesRtl, Matching) {
  EXPECT_EQ(
      in_icarus({"matching", "--size 32x16 --frames 2 -s matching.parallelism=8 -s matching.iterations=3",
                 ".WIDTH(32), .HEIGHT(16), .P(8), .ITERATIONS(3)"}),
      "");
  EXPECT_EQ(
      in_icarus({"matching",
                 "--size 32x16 -s matching.parallelism=16 -s matching.iterations=1 -s matching.cost_weight=1 "
                 "-s matching.p1=0 -s matching.p2=255 -s census.window_width=3 -s matching.latency=4",
                 ".WIDTH(32), .HEIGHT(16), .P(16), .ITERATIONS(1), .COST_WEIGHT(1), .P1(0), .P2(255), "
                 ".CODE_BITS(14), .LATENCY(4)"}),
      "");
  EXPECT_EQ(
      in_icarus({"matching",
                 "--size 32x16 -s matching.parallelism=5 -s matching.iterations=2 -s matching.cost_weight=3 "
                 "-s matching.p1=3 -s matching.p2=7 -s matching.interval=2",
                 ".WIDTH(32), .HEIGHT(16), .P(5), .ITERATIONS(2), .COST_WEIGHT(3), .P1(3), .P2(7), "
                 ".INTERVAL(2)"}),
      "");
  EXPECT_EQ(
      in_icarus({"matching",
                 "--size 32x16 -s matching.parallelism=1 -s matching.iterations=5 -s matching.cost_weight=4",
                 ".WIDTH(32), .HEIGHT(16), .P(1), .ITERATIONS(5), .COST_WEIGHT(4)"}),
      "");
}

TEST(ReferenceValuesRtl, Subpixel) {
  EXPECT_EQ(
      in_icarus({"subpixel", "--size 32x16 --frames 2 -s matching.parallelism=8 -s matching.iterations=3",
                 ".WIDTH(32), .HEIGHT(16), .P(8), .ITERATIONS(3)"}),
      "");
  EXPECT_EQ(
      in_icarus({"subpixel",
                 "--size 32x16 -s matching.parallelism=5 -s matching.iterations=4 -s "
                 "matching.disparity_offset=3 -s subpixel.border_width=0 -s subpixel.border_height=1 -s "
                 "subpixel.latency=7",
                 ".WIDTH(32), .HEIGHT(16), .P(5), .ITERATIONS(4), .OFFSET(3), .BORDER_WIDTH(0), "
                 ".BORDER_HEIGHT(1), .LATENCY(7)"}),
      "");
  EXPECT_EQ(in_icarus({"subpixel", "--size 32x16 -s matching.parallelism=1 -s matching.iterations=17",
                       ".WIDTH(32), .HEIGHT(16), .P(1), .ITERATIONS(17)"}),
            "");
  EXPECT_EQ(in_icarus({"subpixel", "--size 32x16 -d 32", ".WIDTH(32), .HEIGHT(16), .P(32), .ITERATIONS(1)"}),
            "");
}

TEST(ReferenceValuesRtl, Uniqueness) {
  EXPECT_EQ(
      in_icarus({"uniqueness", "--size 32x16 --frames 2 -s matching.parallelism=8 -s matching.iterations=3",
                 ".WIDTH(32), .HEIGHT(16), .P(8), .ITERATIONS(3)"}),
      "");
  EXPECT_EQ(
      in_icarus(
          {"uniqueness",
           "--size 32x16 -s matching.parallelism=1 -s matching.iterations=17 -s uniqueness.factor=400 -s "
           "uniqueness.latency=3",
           ".WIDTH(32), .HEIGHT(16), .P(1), .ITERATIONS(17), .FACTOR(400), .LATENCY(3)"}),
      "");
  EXPECT_EQ(
      in_icarus({"uniqueness",
                 "--size 32x16 -s matching.parallelism=3 -s matching.iterations=7 -s uniqueness.factor=256",
                 ".WIDTH(32), .HEIGHT(16), .P(3), .ITERATIONS(7), .FACTOR(256)"}),
      "");
  EXPECT_EQ(
      in_icarus({"uniqueness", "--size 32x16 -d 32", ".WIDTH(32), .HEIGHT(16), .P(32), .ITERATIONS(1)"}), "");
}

// Offsets that leave the image at the bottom, and at both sides.
TEST(ReferenceValuesRtl, Rectification) {
  EXPECT_EQ(in_icarus({"rectification", "--size 32x16 -d 32 --frames 2 -s rectification.window=9",
                       ".WIDTH(32), .HEIGHT(16), .WINDOW(9), .OFFSET_BITS(9)"}),
            "");
  EXPECT_EQ(in_icarus({"rectification", "--size 32x48 -d 32 -s rectification.window=15",
                       ".WIDTH(32), .HEIGHT(48), .WINDOW(15), .OFFSET_BITS(9)"}),
            "");
  EXPECT_EQ(
      in_icarus({"rectification",
                 "--size 32x16 -d 32 -s rectification.window=15 -s rectification.fraction_bits=3 -s "
                 "rectification.latency=8",
                 ".WIDTH(32), .HEIGHT(16), .WINDOW(15), .FRACTION_BITS(3), .OFFSET_BITS(7), .LATENCY(8)"}),
      "");
}

TEST(ReferenceValuesRtl, NoiseReduction) {
  EXPECT_EQ(in_icarus({"noise_reduction", kSmall, ".WIDTH(64), .HEIGHT(32)"}), "");
  EXPECT_EQ(in_icarus({"noise_reduction",
                       "--size 32x32 -d 32 -s subpixel.mask_border=false -s noise_reduction.window=5 -s "
                       "noise_reduction.max_difference=7 -s "
                       "noise_reduction.latency=7",
                       ".WIDTH(32), .HEIGHT(32), .WINDOW(5), .MAX_DIFFERENCE(7), .LATENCY(7)"}),
            "");
  EXPECT_EQ(
      in_icarus({"noise_reduction",
                 "--size 32x16 -d 32 -s noise_reduction.window=7 -s noise_reduction.max_difference=4094",
                 ".WIDTH(32), .HEIGHT(16), .WINDOW(7), .MAX_DIFFERENCE(4094)"}),
      "");
}

// Two images that have nothing in common: disparities, and invalid ones, as random as they become.
std::string noise_pair(const Program& program) {
  std::mt19937 random(5);
  for (const char* const name : {"noise_left.pgm", "noise_right.pgm"}) {
    std::string text = "P5 32 16 255\n";
    for (int i = 0; i < 32 * 16; ++i) text += static_cast<char>(random() >> 24);
    program.folder().write(name, text);
  }
  return "--left noise_left.pgm --right noise_right.pgm -d 32";
}

constexpr const char* kMedian = "-s noise_reduction.kind=median_3x3 -s subpixel.mask_border=false";

TEST(ReferenceValuesRtl, Median) {
  EXPECT_EQ(in_icarus({"noise_reduction", fmt::format("{} {}", kSmall, kMedian), ".WIDTH(64), .HEIGHT(32)",
                       "median_3x3"}),
            "");
  EXPECT_EQ(in_icarus({"noise_reduction",
                       fmt::format("--size 32x48 -d 32 -s noise_reduction.latency=3 "
                                   "-s noise_reduction.interval=2 {}",
                                   kMedian),
                       ".WIDTH(32), .HEIGHT(48), .LATENCY(3), .INTERVAL(2)", "median_3x3"}),
            "");
}

// Both simulators take the same cycles; Verilator finds nothing to warn of in the circuits.
void expect_both_simulators_pass(const Program& program, const Circuit& circuit) {
  ASSERT_EQ(written_vectors(program, circuit), "");
  const Said built =
      shell(program,
            fmt::format("iverilog -g2012 -s {0}_tb -y '{1}' -Y .sv {2} -o sim {0}_tb.sv && verilator "
                        "--binary --timing -CFLAGS -O0 --top-module {0}_tb -y '{1}' {2} {0}_tb.sv >log 2>&1 "
                        "|| {{ cat log; exit 9; }}",
                        circuit.stage, source_path("modules/rtl"), circuit.dut()));
  ASSERT_EQ(built.code, 0) << built.text;
  for (const char* const arguments : {"+stall=0", "+seed=5 +stall=100"}) {
    const Said a = shell(program, fmt::format("vvp -n sim {}", arguments));
    const Said b = shell(program, fmt::format("obj_dir/V{}_tb {}", circuit.stage, arguments));
    EXPECT_EQ(a.text.rfind("PASS ", 0), 0U) << a.text;
    EXPECT_EQ(a.text.substr(0, a.text.find('\n')), b.text.substr(0, b.text.find('\n')));
  }
}

TEST(ReferenceValuesRtl, MatchingInVerilator) {
  expect_both_simulators_pass(Program(),
                              {"matching", "--size 32x16 -s matching.parallelism=4 -s matching.iterations=3",
                               ".WIDTH(32), .HEIGHT(16), .P(4), .ITERATIONS(3)"});
}

TEST(ReferenceValuesRtl, MedianOfNoiseInVerilator) {
  const Program program;
  expect_both_simulators_pass(program, {"noise_reduction", fmt::format("{} {}", noise_pair(program), kMedian),
                                        ".WIDTH(32), .HEIGHT(16)", "median_3x3"});
}

}  // namespace reference_values_rtl_test
}  // namespace parallax::test
