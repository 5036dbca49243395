// SPDX-License-Identifier: Apache-2.0
// The test benches that parallax vectors writes, in Icarus Verilog and in Verilator, with circuits that are
// right and wrong.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/program.hpp"

namespace parallax::test {
namespace vectors_rtl_test {

struct Ended {
  int code = -1;
  std::string said;
};

class TestBench : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(program_("vectors --stage census --size 64x48 -d 32 --frames 2 --out v -q").code, 0);
  }

  Ended in_folder(const std::string& command) const {
    const std::string line =
        fmt::format("cd '{}' && {{ {}; }} >said 2>&1", (program_ / "v").string(), command);
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 1000, program_.read("v/said")};
  }
  static std::string circuit() { return source_path("tests/rtl/census_5x5.sv"); }

  Ended icarus(const std::string& options, const std::string& arguments = "") const {
    return in_folder(
        fmt::format("iverilog -g2012 -Wall -DDUT=census_5x5 {} -o sim census_tb.sv {} && vvp sim {}", options,
                    circuit(), arguments));
  }
  /// Compiles once; +arguments choose the run.
  Ended verilator(const std::string& options, const std::string& arguments) const {
    return in_folder(
        fmt::format("verilator --binary --timing -O3 -DDUT=census_5x5 {0} --top-module census_tb -Mdir "
                    "obj{1} census_tb.sv {2} "
                    ">build{1} 2>&1 || {{ cat build{1}; exit 9; }}; obj{1}/Vcensus_tb {3}",
                    options, std::hash<std::string>()(options) % 1000, circuit(), arguments));
  }
  static std::string last_line(const std::string& text, const std::string& with) {
    std::string found;
    for (const std::string& line : lines(text)) {
      if (line.find(with) != std::string::npos) found = line;
    }
    return found;
  }
  static std::string verdict(const Ended& ended) {
    const std::string pass = last_line(ended.said, "PASS "), fail = last_line(ended.said, "FAIL ");
    return fail.empty() ? pass.substr(0, pass.find(", in ")) : fail;
  }

  Program program_;
};

constexpr const char* kPass = "PASS census: 6144 tokens of left_codes, 6144 tokens of right_codes";

TEST_F(TestBench, PassesTheRightCircuitUnderAnyStalls) {
  for (const char* const arguments : {"", "+seed=7", "+seed=8 +stall=200", "+stall=0"}) {
    const Ended ended = icarus("", arguments);
    EXPECT_EQ(ended.code, 0) << ended.said;
    EXPECT_EQ(verdict(ended), kPass) << ended.said;
  }
  const Ended ended = verilator("", "+seed=7");
  EXPECT_EQ(ended.code, 0) << ended.said;
  EXPECT_EQ(verdict(ended), kPass) << ended.said;
}

// For as long as +pause says nothing moves, where all that is due waits for one port; without stalls there
// are no pauses.
TEST_F(TestBench, PausesForAsLongAsItIsTold) {
  for (const char* const arguments :
       {"+pause=3000 +timeout=3500", "+pause=0 +timeout=2500", "+stall=0 +pause=3000 +timeout=2500"}) {
    const Ended ended = icarus("", arguments);
    EXPECT_EQ(ended.code, 0) << arguments << ended.said;
    EXPECT_EQ(verdict(ended), kPass) << arguments << ended.said;
  }
  const Ended ended = icarus("", "+pause=3000 +timeout=2500");
  EXPECT_EQ(ended.code, 1) << ended.said;
  EXPECT_NE(ended.said.find("FAIL census: nothing has moved for 2501 cycles"), std::string::npos)
      << ended.said;
}

// Both simulators say the same of the same stalls, to the cycle.
TEST_F(TestBench, SaysTheSameInBothSimulators) {
  const std::string first = "left_codes: the first difference is token ";
  for (const char* const fault : {"-DFAULT_COMPARISON", "-DFAULT_HANGS"}) {
    const Ended a = icarus(fault, "+seed=3"), b = verilator(fault, "+seed=3");
    EXPECT_NE(a.code, 0);
    EXPECT_NE(b.code, 0);
    EXPECT_EQ(verdict(a), verdict(b)) << a.said << b.said;
    EXPECT_EQ(last_line(a.said, first), last_line(b.said, first));
    EXPECT_EQ(last_line(a.said, "in_left_ready is"), last_line(b.said, "in_left_ready is"));
  }
}

TEST_F(TestBench, FindsWhatIsWrong) {
  struct Case {
    const char* fault;
    const char* says;
    const char* pattern;
  };
  for (const Case& each :
       {Case{"-DFAULT_COMPARISON", "left_codes: the first difference is token ", "inverted_comparison"},
        Case{"-DFAULT_ORDER", "left_codes: the first difference is token ", "bit_order"},
        Case{"-DFAULT_BORDER", "left_codes: the first difference is token 0 (frame 0, row 0, column 0)",
             "only_rim"},
        Case{"-DFAULT_LOST", "left_codes: the first difference is token 640 (frame 0, row 10, column 0)",
             "tokens_lost"}}) {
    const Ended ended = icarus(each.fault, "+dump +timeout=5000");
    EXPECT_EQ(ended.code, 1) << each.fault;
    EXPECT_NE(ended.said.find(each.says), std::string::npos) << each.fault << ended.said;
    EXPECT_EQ(verdict(ended).substr(0, 12), "FAIL census:") << ended.said;
    const Outcome compared =
        program_("compare --vectors v --dump v/left_codes.dump --dump right_codes=v/right_codes.dump --json");
    EXPECT_EQ(compared.code, 1) << each.fault << compared.err;
    const auto tree = nlohmann::json::parse(compared.out);
    EXPECT_EQ(tree.at("stream"), "left_codes") << each.fault;
    EXPECT_EQ(tree.at("pattern"), each.pattern) << each.fault << compared.out;
    EXPECT_TRUE(tree.at("streams").at(1).at("equal").get<bool>() ||
                each.fault == std::string("-DFAULT_LOST"));
  }
}

TEST_F(TestBench, NamesTheHandshakeThatStalls) {
  const Ended ended = icarus("-DFAULT_HANGS", "+timeout=2000");
  EXPECT_EQ(ended.code, 1);
  EXPECT_NE(ended.said.find("FAIL census: nothing has moved for 2001 cycles"), std::string::npos)
      << ended.said;
}

TEST_F(TestBench, SeesATokenThatIsWithdrawn) {
  const Ended ended = icarus("-DFAULT_WITHDRAWN", "+stall=220 +timeout=5000");
  EXPECT_EQ(ended.code, 1);
  EXPECT_NE(ended.said.find("out_left_valid is withdrawn in cycle "), std::string::npos) << ended.said;
}

// What a simulator says of a missing file ends in code 0, and Verilator takes zeros for the words.
TEST_F(TestBench, RefusesVectorsThatAreMissingCutOrOthers) {
  const std::string says =
      "FAIL census: left_rectified.memh is not here, or not the one that was written with this test bench";
  const std::string whole = program_.read("v/left_rectified.memh");
  program_.folder().write("v/left_rectified.memh", whole.substr(0, whole.size() / 2));
  EXPECT_EQ(verdict(icarus("")), says);
  EXPECT_EQ(verdict(verilator("", "")), says);
  std::filesystem::remove(program_ / "v/left_rectified.memh");
  EXPECT_EQ(icarus("").code, 1);
  EXPECT_EQ(verdict(verilator("", "")), says);
}

// Waves of the test bench are a dump, too.
TEST_F(TestBench, ItsWavesAreComparedAsADump) {
  ASSERT_EQ(icarus("", "+vcd").code, 0);
  const Outcome equal =
      program_("compare --vectors v --dump v/census.vcd --dump left_rectified=v/census.vcd");
  EXPECT_EQ(equal.code, 0) << equal.err << equal.out;
  EXPECT_EQ(equal.out, "left_codes: equal, 6144 tokens\nleft_rectified: equal, 6144 tokens\n");
}

// Nothing behind the ports is a circuit that never answers.
TEST_F(TestBench, TheStubHasThePortsAndNothingBehindThem) {
  const Ended ended =
      in_folder("iverilog -g2012 -Wall -o stub census_tb.sv census_stub.sv && vvp stub +timeout=300");
  EXPECT_EQ(ended.code, 1) << ended.said;
  EXPECT_NE(ended.said.find(
                "left_rectified: the circuit took 0 of 6144 tokens; in_left_valid is 1, in_left_ready is 0"),
            std::string::npos)
      << ended.said;
}

TEST_F(TestBench, OfEveryStageCompiles) {
  for (const char* const stage :
       {"unpack_left", "unpack_map", "map_decoder", "rectification", "matching", "subpixel", "uniqueness",
        "consistency", "texture", "speckle", "gap_interpolation", "noise_reduction", "output_packing"}) {
    ASSERT_EQ(program_(fmt::format("vectors --stage {} --size 64x48 -d 32 --out v -q", stage)).code, 0);
    const Ended ended = in_folder(
        fmt::format("iverilog -g2012 -Wall -o stub {0}_tb.sv {0}_stub.sv && vvp stub +timeout=300", stage));
    EXPECT_EQ(ended.code, 1) << ended.said;
    EXPECT_EQ(ended.said.find("warning"), std::string::npos) << ended.said;
    EXPECT_NE(ended.said.find(fmt::format("FAIL {}: nothing has moved for 301 cycles", stage)),
              std::string::npos)
        << ended.said;
  }
}

}  // namespace vectors_rtl_test
}  // namespace parallax::test
