// SPDX-License-Identifier: Apache-2.0
// parallax fifo, as its user meets it: from waves to the lines of a preset, and each line with which it
// refuses.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/program.hpp"

namespace parallax {
namespace fifo_test {

class Fifo : public ::testing::Test {
 protected:
  /// The one line with which the command refuses, having written nothing.
  std::string refusal(const std::string& arguments) const {
    const auto before = program_.files();
    const test::Outcome outcome = program_("fifo " + arguments);
    EXPECT_EQ(outcome.code, 2) << arguments << '\n' << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(program_.files(), before) << arguments;
    EXPECT_EQ(test::lines(outcome.err).size(), 1U) << outcome.err;
    const std::string prefix = "parallax: error: ";
    return outcome.err.substr(std::min(prefix.size(), outcome.err.size()));
  }
  std::string refusal_of(const std::string& waves) const {
    program_.folder().write("waves", waves);
    return refusal("waves");
  }

  test::Program program_;
};

constexpr const char* kHead = "rst,write_valid,write_ready,read_valid,read_ready\n";
// One slot, readable and free an edge later, not ready in the first cycle.
constexpr const char* kSlot =
    "1,0,0,0,0\n0,1,0,0,0\n0,1,1,0,0\n0,1,0,1,0\n0,1,0,1,0\n0,1,0,1,1\n0,1,1,0,0\n0,1,0,1,0\n"
    "0,1,0,1,1\n0,1,1,0,0\n0,1,0,1,1\n0,1,1,0,0\n0,1,0,1,0\n";

TEST_F(Fifo, PrintsTheLinesOfAPreset) {
  program_.folder().write("slot.csv", std::string(kHead) + kSlot);
  const test::Outcome outcome = program_("fifo slot.csv --stream winners");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "streams.winners.kind = \"registered\"\n"
            "streams.winners.depth = 1\n"
            "streams.winners.not_ready_cycles = 1\n"
            "# exact for all 4 tokens; 4 were awaited by the reader, 3 by the writer\n");
  // As such a file, too.
  program_.folder().write("slot.toml", "inherits = \"scenescan-pro\"\n" + outcome.out);
  const test::Outcome configured = program_("config --preset slot.toml");
  EXPECT_EQ(configured.code, 0) << configured.err;
  EXPECT_NE(configured.out.find("winners.not_ready_cycles = 1"), std::string::npos);
  EXPECT_EQ(program_("fifo slot.csv -q").out, "");
}

TEST_F(Fifo, HasTheSameAsJson) {
  program_.folder().write("slot.csv", std::string(kHead) + kSlot);
  const auto tree = nlohmann::json::parse(program_("fifo slot.csv --json").out);
  EXPECT_EQ(tree.at("kind"), "registered");
  EXPECT_EQ(tree.at("depth"), 1);
  EXPECT_EQ(tree.at("clocks"), 1);
  EXPECT_EQ(tree.at("preset").at(0), "streams.NAME.kind = \"registered\"");
}

TEST_F(Fifo, SaysWhyThereIsNoDescription) {
  // The second token takes two edges.
  program_.folder().write("late.csv",
                          std::string(kHead) + "0,1,1,0,1\n0,0,1,1,1\n0,1,1,0,1\n0,0,1,0,1\n0,0,1,1,1\n");
  const test::Outcome outcome = program_("fifo late.csv");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.out,
            "no description: how long a token takes to the reader is not constant: token 0 can be read 1 "
            "edge after it is "
            "written, token 1 after 2 edges\n"
            "first at            late.csv, token 1, cycle 4, 1 token held\n");
  program_.folder().write("idle.csv", std::string(kHead) + "0,1,1,0,1\n0,0,1,1,1\n");
  const test::Outcome idle = program_("fifo idle.csv");
  EXPECT_EQ(idle.code, 1);
  EXPECT_EQ(idle.out,
            "not enough stalls: the FIFO is never seen to be full and to take a token again: its depth is at "
            "least 1; let "
            "the reader rest until the writer has to wait, and read again\n");
  const auto tree = nlohmann::json::parse(program_("fifo late.csv --json").out);
  EXPECT_EQ(tree.at("described"), false);
  EXPECT_EQ(tree.at("first").at("cycle"), 4);
}

TEST_F(Fifo, RefusesWhatIsNoWaves) {
  EXPECT_EQ(refusal_of(""), "waves: the file is empty\n");
  EXPECT_EQ(
      refusal_of("a,b\n0,1\n"),
      "waves: no signal is called write_ready or s_axis_tready or in_ready or wr_ready, for write_ready, "
      "nor full or wr_full, for full; --signals write_ready=NAME or full=NAME names it\n");
  EXPECT_EQ(refusal_of("write_ready,b\n0,1\n"),
            "waves: no signal is called write_valid or s_axis_tvalid or in_valid or wr_valid or wr_en, for "
            "write_valid; --signals write_valid=NAME names it\n");
  EXPECT_EQ(refusal_of(std::string(kHead) + "0,1,1,0\n"), "waves, line 2: 4 columns in place of 5\n");
  EXPECT_EQ(refusal_of(std::string(kHead) + "0,1,1,0,yes\n"),
            "waves, line 2: read_ready is 'yes', it should be 0 or 1\n");
  EXPECT_EQ(refusal_of(std::string(kHead) + "0,1,x,0,0\n"),
            "waves: write_ready is unknown (x) in cycle 0 after reset\n");
  EXPECT_EQ(refusal_of("write_valid,write_ready,read_valid,read_ready\n0,x,0,0\n"),
            "waves: write_ready is unknown (x) in cycle 0; --signals reset=NAME or reset_n=NAME says when it "
            "is over\n");
  EXPECT_EQ(refusal_of(std::string(kHead) + "1,0,0,0,0\n"),
            "waves: no rising edge of the write clock after rst\n");
  EXPECT_EQ(refusal_of(std::string(kHead) + "0,1,1,0,0\n1,0,0,0,0\n"),
            "waves: rst resets the FIFO again in cycle 1; one run after one reset is described\n");
  EXPECT_EQ(refusal_of("$enddefinitions $end\n"), "waves: no signals in this file\n");
  EXPECT_EQ(
      refusal_of(
          "$var wire 2 ! write_valid $end\n$var wire 1 # write_ready $end\n$var wire 1 $ read_valid $end\n"
          "$var wire 1 % read_ready $end\n$var wire 1 & clk $end\n$enddefinitions $end\n"),
      "waves: write_valid has 2 bits, it should have 1\n");
  const std::string one =
      "$var wire 1 ! write_valid $end\n$var wire 1 # write_ready $end\n$var wire 1 $ read_valid $end\n"
      "$var wire 1 % read_ready $end\n$var wire 1 & clk $end\n$enddefinitions $end\n";
  EXPECT_EQ(refusal_of(one + "#x\n"), "waves, line 7: '#x' is no date\n");
  EXPECT_EQ(refusal_of(one + "#5\n#4\n"), "waves, line 8: date 4 is before 5\n");
  EXPECT_EQ(refusal("absent.vcd").rfind("absent.vcd", 0), 0U);
  // Named as the module's ports, for which the test bench was written.
  program_.folder().write("bench.vcd", "$scope module fifo_bench $end\n$var wire 1 ~ rst $end\n" + one);
  EXPECT_EQ(
      refusal("bench.vcd --signals reset_n=rst_n"),
      "bench.vcd: no signal rst_n for reset_n; the nearest is fifo_bench.rst; these are waves of parallax "
      "fifo --bench, whose names are known: leave --signals out\n");
}

TEST_F(Fifo, RefusesOptionsThatDoNotFit) {
  program_.folder().write("slot.csv", std::string(kHead) + kSlot);
  EXPECT_EQ(refusal(""),
            "parallax fifo takes either waves to describe, or --bench DIR to write a test bench\n");
  EXPECT_EQ(refusal("slot.csv --bench b --module m"),
            "parallax fifo takes either waves to describe, or --bench DIR to write a test bench\n");
  EXPECT_EQ(refusal("slot.csv --no-reset"),
            "--module, --parameters, --connect and --no-reset belong to --bench\n");
  EXPECT_EQ(refusal("slot.csv --stream winer"),
            "--stream: there is no stream 'winer'; the nearest is winners\n");
  EXPECT_EQ(refusal("slot.csv --signals write=a"),
            "--signals: 'write=a' is not ROLE=NAME with one of the roles write_valid, write_ready, full, "
            "read_valid, "
            "read_ready, empty, clock, write_clock, read_clock, reset, reset_n\n");
  EXPECT_EQ(refusal("slot.csv --signals write_ready=a,full=b"),
            "--signals: write_ready and full say the same, give one\n");
  EXPECT_EQ(
      refusal("slot.csv --signals write_clock=a"),
      "--signals: of write_clock and read_clock one is missing; a FIFO with one clock has clock=NAME\n");
  EXPECT_EQ(refusal("slot.csv --signals write_ready=redy"),
            "slot.csv: no signal redy for write_ready; the nearest is rst; --signals write_ready=NAME names "
            "another one\n");
  EXPECT_EQ(refusal("--bench b"), "--bench needs --module NAME, the module of the FIFO\n");
  EXPECT_EQ(refusal("--bench b --module 2m"), "--module: '2m' is no name that Verilog has\n");
  EXPECT_EQ(refusal("--bench b --module m --parameters DEPTH"), "--parameters: 'DEPTH' is not NAME=VALUE\n");
  EXPECT_EQ(refusal("--bench b --module m --connect a=@b"),
            "--connect: 'a=@b' is no value that Verilog has\n");
  EXPECT_EQ(refusal("--bench b --module m --signals clock=a-b"),
            "--signals: 'a-b' is no name that Verilog has\n");
  EXPECT_EQ(refusal("--bench b --module m --no-reset --signals reset=r"),
            "--no-reset: --signals names a reset\n");
}

TEST_F(Fifo, WritesATestBench) {
  const test::Outcome outcome =
      program_("fifo --bench b --module m --parameters DEPTH=64 --connect s_axis_tlast=1'b1");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "test bench          b/fifo_bench.sv, for the module m\n");
  const std::string bench = program_.read("b/fifo_bench.sv");
  for (const char* const text :
       {"  m #(\n    .DEPTH(64)\n  ) dut (", ".clk(clk)", ".rst(rst)", ".s_axis_tvalid(write_valid)",
        ".m_axis_tready(read_ready)", ".s_axis_tlast(1'b1)"}) {
    EXPECT_NE(bench.find(text), std::string::npos) << text << bench;
  }
  EXPECT_EQ(bench.find('@' + std::string("m")), std::string::npos);
}

}  // namespace fifo_test
}  // namespace parallax
