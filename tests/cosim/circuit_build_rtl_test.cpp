// SPDX-License-Identifier: Apache-2.0
// What a run and parallax circuit say of Verilog of which they make no circuit.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>

#include "tests/cli/program.hpp"
#include "tests/paths.hpp"

namespace parallax::test {
namespace circuit_build_rtl_test {

void expect_refused(const Outcome& outcome, const std::string& message) {
  EXPECT_EQ(outcome.code, 2) << outcome.out;
  EXPECT_EQ(outcome.err, "parallax: error: " + message + "\n");
}

class CircuitBuild : public ::testing::Test {
 protected:
  Outcome build(const std::string& verilog, const std::string& options = "--out c.so",
                const std::function<void()>& prepare = {}) const {
    program.folder().write("c.sv", verilog);
    return program("circuit c.sv " + options, prepare);
  }
  /// A tool that does nothing else.
  void write_tool(const std::string& name, const std::string& script) const {
    program.folder().write("bin/" + name, "#!/bin/sh\n" + script);
    std::filesystem::permissions(program / ("bin/" + name), std::filesystem::perms::owner_all);
  }
  std::function<void()> with_tools_of_its_own() const {
    return [path = (program / "bin").string()] { ::setenv("PATH", path.c_str(), 1); };
  }
  const Program program;
};

constexpr const char* kModule = "module c(input clk, output o); assign o = clk; endmodule\n";

TEST_F(CircuitBuild, RefusesWhatIsNoCircuit) {
  expect_refused(
      build("module c(input clk, inout [3:0] bus); endmodule\n"),
      "the circuit's pin bus is an inout: pins are inputs and outputs of one dimension; put a module "
      "around it");
  expect_refused(
      build("module c(input [7:0] a [0:3], output o); assign o = a[0][0]; endmodule\n"),
      "the circuit's pin a is an array: pins are inputs and outputs of one dimension; put a module "
      "around it");
  expect_refused(build("module c; endmodule\n"), "c.sv: the circuit's top module has no pins");
  expect_refused(build("module c(input a); endmodule\nmodule d(input a); endmodule\n"),
                 "these modules can be the circuit: c, d; --circuit-top NAME says which");
  expect_refused(build(kModule, "--out c.so --circuit-parameter WIDE=3"),
                 "verilator: %Error: Parameters from the command line were not found in the design: WIDE");
  expect_refused(build(kModule, "--out c.so --circuit-top d"),
                 "verilator: %Error: Specified --top-module 'd' was not found in design.");
  program.folder().write("c.vhd", "entity c is end;\n");
  expect_refused(
      program("circuit c.vhd --out c.so"),
      "c.vhd is VHDL; ghdl --synth --std=08 --out=verilog c.vhd -e ENTITY > ENTITY.v makes Verilog of "
      "it");
}

// A file and a module in two folders, and macros with a value and without.
TEST_F(CircuitBuild, FindsWhatLiesElsewhere) {
  program.folder().write("inc/w.vh", "`define W 12\n");
  program.folder().write("lib/through.v",
                         "module through(input [`WIDE:0] a, output [`WIDE:0] b); assign b = a; endmodule\n");
  const std::string top =
      "`include \"w.vh\"\nmodule c(input [`W-1:0] in_disparity, output [`W-1:0] out_disparity);\n"
      "  through one(in_disparity, out_disparity);\n`ifndef PLAIN\n  no such thing\n`endif\nendmodule\n";
  const auto said = [&](const std::string& options) { return build(top, "--out c.so " + options).err; };
  const auto expect_said = [](const std::string& text, const std::string& end) {
    ASSERT_GE(text.size(), end.size());
    EXPECT_EQ(text.substr(text.size() - end.size()), end);
  };
  expect_said(said(""), "Cannot find include file: w.vh; --circuit-include DIR says where it is\n");
  const std::string includes = "--circuit-include inc --circuit-define PLAIN ";
  expect_said(said(includes),
              "Cannot find file containing module: 'through'; several files may be given, or "
              "--circuit-include DIR says where it is\n");
  expect_said(said(includes + "--circuit-include lib "),
              "Define or directive not defined: '`WIDE'; --circuit-define NAME[=VALUE] defines it\n");
  expect_refused(build(top, "--out c.so --circuit-include none"), "--circuit-include: none is no folder");
  expect_refused(build(top, "--out c.so --circuit-define =3"),
                 "--circuit-define: '=3' is not NAME[=VALUE], as SIMULATION or WIDTH=640");
  const Outcome outcome = program(
      "run --size 32x16 --timing-frames 1 --no-verdict --circuit noise_reduction=c.sv,lib/through.v "
      "--circuit-include inc --circuit-define PLAIN --circuit-define WIDE=11");
  EXPECT_EQ(outcome.code, 1) << "it reduces no noise: " << outcome.err;
}

// Not by the file, whose name Verilator takes.
TEST_F(CircuitBuild, IsCalledByItsTopModule) {
  ASSERT_EQ(
      build("module part(input [11:0] a, output [11:0] b); assign b = a; endmodule\n"
            "module pass #(parameter WIDTH = 8) (input clk, input [WIDTH - 1:0] in_disparity,\n"
            "  output [WIDTH - 1:0] out_disparity);\n  part one(in_disparity, out_disparity);\nendmodule\n",
            "--out c.so --circuit-parameter WIDTH=12")
          .code,
      0);
  const Outcome outcome =
      program("run --size 32x16 --timing-frames 1 --no-verdict --circuit noise_reduction=c.so");
  EXPECT_EQ(outcome.code, 1) << "it reduces no noise: " << outcome.err;
  EXPECT_NE(outcome.out.find("circuit             pass in the place of noise_reduction, "), std::string::npos)
      << outcome.out;
}

// What takes most of the time is not begun.
TEST_F(CircuitBuild, LooksAtThePinsBeforeItCompiles) {
  program.folder().write("c.sv",
                         "module c(input clk, input [3:0] mode, output q); assign q = clk; endmodule\n");
  write_tool("g++", "exit 1\n");
  const std::string path = (program / "bin").string() + ":" + std::getenv("PATH");
  expect_refused(
      program("run --size 32x16 --no-verdict --timing-frames 1 --circuit noise_reduction=c.sv",
              [path] { ::setenv("PATH", path.c_str(), 1); }),
      "circuit c: noise_reduction has no pin for in_disparity.data (12 bits), out_disparity.data (12 "
      "bits), such as in_disparity_data; nothing drives the input mode (4 bits); nothing reads the "
      "output q (1 bit); --circuit-pins in_disparity.data=PIN names it; --circuit-pins ROLE=mode "
      "says what it is, --circuit-set mode=VALUE what it is to be");
}

TEST_F(CircuitBuild, SaysWhereItCannotWrite) {
  expect_refused(build(kModule, "--out none/c.so"), "cannot write none/c.so: No such file or directory");
  expect_refused(build(kModule, "--out ."), "cannot write .: Is a directory");
  expect_refused(build(kModule, "--out c.so", [] { ::setenv("TMPDIR", "/none", 1); }),
                 "cannot make a folder in /none: No such file or directory");
}

TEST_F(CircuitBuild, SaysWhichToolIsMissing) {
  expect_refused(build(kModule, "--out c.so", with_tools_of_its_own()),
                 "verilator is not installed, which circuits in Verilog need: apt-get install verilator");
  write_tool("verilator", "");
  expect_refused(build(kModule, "--out c.so", with_tools_of_its_own()),
                 "Verilator has written no top module");
  write_tool("verilator",
             "while [ $# -gt 1 ]; do [ \"$1\" = --Mdir ] && cd \"$2\"; shift; done\n"
             "echo 'VL_IN8(&clk,0,0);' > Vc.h; : > Vc___024root.h\n");
  expect_refused(build(kModule, "--out c.so", with_tools_of_its_own()),
                 "g++ is not installed, which circuits in Verilog need: apt-get install g++");
  write_tool("g++", "echo 'c.cpp:1: error: no space'; echo more; exit 1\n");
  expect_refused(build(kModule, "--out c.so", with_tools_of_its_own()), "g++: c.cpp:1: error: no space");
  std::filesystem::permissions(program / "bin/verilator", std::filesystem::perms::owner_read);
  expect_refused(build(kModule, "--out c.so", with_tools_of_its_own()),
                 "cannot run verilator: Permission denied");
  EXPECT_FALSE(std::filesystem::exists(program / "c.so"));
}

TEST_F(CircuitBuild, NeedsTheProgramAsAWhole) {
  std::filesystem::copy_file(program_path(), program / "parallax");
  program.folder().write("c.sv", kModule);
  const std::string command =
      fmt::format("cd '{}' && ./parallax circuit c.sv --out c.so 2> said", program.folder().path().string());
  EXPECT_NE(std::system(command.c_str()), 0);
  const std::string folder = program.folder().path().string();
  EXPECT_EQ(
      program.read("said"),
      fmt::format("parallax: error: circuit.h is neither in {}/circuit nor in {}/share/parallax/circuit: "
                  "install parallax as a whole\n",
                  folder, program.folder().path().parent_path().string()));
}

}  // namespace circuit_build_rtl_test
}  // namespace parallax::test
