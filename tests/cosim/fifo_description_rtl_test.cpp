// SPDX-License-Identifier: Apache-2.0
// parallax fifo finds of each circuit in tests/rtl what it is, from the waves that its own test bench writes,
// in Icarus Verilog and in Verilator.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/program.hpp"
#include "tests/paths.hpp"

namespace parallax::test {
namespace fifo_description_rtl_test {

using nlohmann::json;

constexpr const char* kHandshake =
    "write_valid=in_valid,write_ready=in_ready,read_valid=out_valid,read_ready=out_ready";

struct Circuit {
  std::string module;
  std::string parameters;
  std::string kind;
  int depth, write_to_read, read_to_write, not_ready_cycles = 0;
};

class FifoBench : public ::testing::Test {
 protected:
  int shell(const std::string& command) const {
    const int status = std::system(
        fmt::format("cd '{}' && {{ {}; }} >said 2>&1", program_.folder().path().string(), command).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000;
  }
  // The test bench of a circuit in Icarus Verilog; waves in fifo_bench.vcd.
  void simulate(const std::string& module, const std::string& options,
                const std::string& arguments = "") const {
    const Outcome bench = program_("fifo --bench . --module " + module + " " + options);
    ASSERT_EQ(bench.code, 0) << bench.err;
    ASSERT_EQ(shell(fmt::format("iverilog -g2012 -Wall -o sim -s fifo_bench fifo_bench.sv {} && vvp sim {}",
                                source_path("tests/rtl/" + module + ".sv"), arguments)),
              0)
        << program_.read("said");
  }
  json described(const std::string& arguments = "fifo_bench.vcd") const {
    const Outcome outcome = program_("fifo --json " + arguments);
    EXPECT_LE(outcome.code, 1) << outcome.err;
    const json tree = json::parse(outcome.out);
    EXPECT_EQ(tree.at("described"), outcome.code == 0);
    return tree;
  }
  static void expect(const json& tree, const Circuit& circuit) {
    SCOPED_TRACE(circuit.module + " " + circuit.parameters + tree.dump());
    ASSERT_TRUE(tree.at("described"));
    EXPECT_EQ(tree.at("kind"), circuit.kind);
    EXPECT_EQ(tree.at("depth"), circuit.depth);
    EXPECT_EQ(tree.at("write_to_read"), circuit.write_to_read);
    EXPECT_EQ(tree.at("read_to_write"), circuit.read_to_write);
    EXPECT_EQ(tree.at("not_ready_cycles"), circuit.not_ready_cycles);
  }
  static std::string parameters(const Circuit& circuit) {
    return circuit.parameters.empty() ? "" : " --parameters " + circuit.parameters;
  }

  Program program_;
};

TEST_F(FifoBench, FindsWhatACircuitWithOneClockIs) {
  for (const Circuit& circuit :
       std::vector<Circuit>{{"fifo_registered", "DEPTH=1", "registered", 1, 1, 1},
                            {"fifo_registered", "DEPTH=16", "registered", 16, 1, 1},
                            {"fifo_registered", "DEPTH=100", "registered", 100, 1, 1},
                            {"fifo_first_word_fall_through", "DEPTH=1", "first_word_fall_through", 1, 0, 1},
                            {"fifo_first_word_fall_through", "DEPTH=7", "first_word_fall_through", 7, 0, 1},
                            {"fifo_block_ram", "DEPTH=1", "block_ram", 1, 2, 1},
                            {"fifo_block_ram", "DEPTH=2", "block_ram", 2, 2, 1},
                            {"fifo_block_ram", "DEPTH=64", "block_ram", 64, 2, 1},
                            {"fifo_free", "DEPTH=5,WRITE_TO_READ=3,READ_TO_WRITE=2", "free", 5, 3, 2},
                            {"fifo_free", "DEPTH=1,WRITE_TO_READ=1,READ_TO_WRITE=0", "free", 1, 1, 0},
                            {"fifo_free", "DEPTH=1,WRITE_TO_READ=0,READ_TO_WRITE=0", "free", 1, 0, 0},
                            {"fifo_free", "DEPTH=3,WRITE_TO_READ=0,READ_TO_WRITE=0", "free", 3, 0, 0},
                            {"fifo_free", "DEPTH=2,WRITE_TO_READ=0,READ_TO_WRITE=4", "free", 2, 0, 4},
                            {"fifo_free", "DEPTH=12,WRITE_TO_READ=6,READ_TO_WRITE=1", "free", 12, 6, 1},
                            {"fifo_ram_pipeline", "DEPTH=8,PIPELINE=0", "block_ram", 9, 2, 1},
                            {"fifo_ram_pipeline", "DEPTH=8,PIPELINE=1", "free", 10, 3, 1},
                            {"fifo_ram_pipeline", "DEPTH=16,PIPELINE=3", "free", 20, 5, 1}}) {
    simulate(circuit.module, fmt::format("--no-reset --signals {}{}", kHandshake, parameters(circuit)));
    expect(described(), circuit);
  }
}

TEST_F(FifoBench, FindsWhatARegisterSliceIs) {
  for (const Circuit& circuit :
       std::vector<Circuit>{{"fifo_register_slice", "TYPE=0", "free", 1, 1, 0, 1},
                            {"fifo_register_slice", "TYPE=1", "registered", 1, 1, 1, 1},
                            {"fifo_register_slice", "TYPE=2", "registered", 2, 1, 1, 1},
                            {"fifo_next_state", "", "registered", 1, 1, 1}}) {
    simulate(circuit.module, parameters(circuit));
    expect(described(), circuit);
  }
}

TEST_F(FifoBench, FindsWhatAFifoWithFlagsIs) {
  simulate("fifo_flags",
           "--parameters DEPTH=8 --signals "
           "write_valid=wr_en,full=full,read_ready=rd_en,empty=empty,reset_n=rst_n");
  expect(described(), {"fifo_flags", "DEPTH=8", "registered", 8, 1, 1});
}

TEST_F(FifoBench, FindsWhatAnAsynchronousFifoIs) {
  const std::string signals =
      std::string("--no-reset --signals write_clock=in_clk,read_clock=out_clk,") + kHandshake;
  for (const Circuit& circuit : std::vector<Circuit>{
           {"fifo_asynchronous", "DEPTH=8", "asynchronous", 8, 3, 3},
           {"fifo_asynchronous", "DEPTH=16,TO_READER=6,TO_WRITER=2", "asynchronous", 16, 7, 3},
           {"fifo_asynchronous", "DEPTH=5,TO_READER=1,TO_WRITER=4", "asynchronous", 5, 2, 5}}) {
    for (const char* const periods :
         {"", "+write_period=4000 +read_period=11000", "+write_period=6000 +read_period=6000"}) {
      simulate(circuit.module, signals + parameters(circuit), periods);
      const json tree = described();
      expect(tree, circuit);
      EXPECT_EQ(tree.at("clocks"), 2);
    }
  }
}

TEST_F(FifoBench, FindsNoneForADelayThatDependsOnTheFill) {
  simulate("fifo_bypass", std::string("--no-reset --signals ") + kHandshake);
  const json tree = described();
  EXPECT_EQ(tree.at("described"), false);
  EXPECT_EQ(tree.at("needs_stalls"), false);
  EXPECT_NE(tree.at("reason").get<std::string>().find("how long a token takes to the reader is not constant"),
            std::string::npos);
  EXPECT_GT(tree.at("first").at("held"), 0);
}

// Several runs have one description; those of different circuits have none.
TEST_F(FifoBench, FindsOneForSeveralRuns) {
  const std::string signals = std::string("--no-reset --signals ") + kHandshake;
  for (const char* const seed : {"1", "2", "3"}) {
    simulate("fifo_block_ram", signals + " --parameters DEPTH=9", std::string("+cycles=3000 +seed=") + seed);
    ASSERT_EQ(shell(std::string("mv fifo_bench.vcd run_") + seed + ".vcd"), 0);
  }
  expect(described("run_1.vcd run_2.vcd run_3.vcd"), {"fifo_block_ram", "DEPTH=9", "block_ram", 9, 2, 1});
  simulate("fifo_block_ram", signals + " --parameters DEPTH=10", "+cycles=3000");
  const json tree = described("run_1.vcd run_2.vcd fifo_bench.vcd");
  EXPECT_EQ(tree.at("described"), false);
  EXPECT_EQ(tree.at("first").at("file"), "fifo_bench.vcd");
}

// The same stalls in both simulators, to the cycle.
TEST_F(FifoBench, IsTheSameInVerilator) {
  const std::string signals = std::string("--no-reset --signals ") + kHandshake;
  simulate("fifo_ram_pipeline", signals, "+seed=5");
  const json icarus = described();
  ASSERT_EQ(shell("mv fifo_bench.vcd icarus.vcd"), 0);
  ASSERT_EQ(
      shell(fmt::format("verilator --binary --timing --trace -Wno-fatal --top-module fifo_bench -Mdir obj "
                        "fifo_bench.sv {} && obj/Vfifo_bench +seed=5",
                        source_path("tests/rtl/fifo_ram_pipeline.sv"))),
      0)
      << program_.read("said");
  const json verilator = described();
  expect(verilator, {"fifo_ram_pipeline", "", "free", 10, 3, 1});
  EXPECT_EQ(verilator, icarus);
}

}  // namespace fifo_description_rtl_test
}  // namespace parallax::test
