// SPDX-License-Identifier: Apache-2.0
// The reference circuits (modules/rtl) as yosys makes them: netlists in the test benches of their sources,
// the recorded numbers of cells, and a sample of the changes that break them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tests/cli/program.hpp"

namespace parallax::test {
namespace reference_netlists_rtl_test {

struct Ended {
  int code;
  std::string text;
};

Ended shell(const Program& program, const std::string& command) {
  const int status = std::system(
      fmt::format("cd '{}' && {{ {}; }} >said 2>&1", program.folder().path().string(), command).c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 1000, program.read("said")};
}

std::string script(const std::string& name) {
  return fmt::format("python3 '{}'", source_path("tests/rtl/" + name));
}

// The simulation models of the cells are yosys' own.
std::string simulated_netlist(const std::string& stage, const std::string& vectors) {
  const Program program;
  const Outcome written =
      program(fmt::format("vectors --stage {} --size 32x16 {} --out v -q", stage, vectors));
  if (written.code != 0) return written.err;
  const Ended ran = shell(
      program,
      fmt::format(
          "{0} netlist {1}-small v/netlist.v && cd v && iverilog -g2012 -s {1}_tb -o sim {1}_tb.sv netlist.v "
          "\"$(dirname \"$(readlink -f \"$(command -v yosys)\")\")/../share/yosys/xilinx/cells_sim.v\" && "
          "vvp -n sim +seed=2",
          script("synthesise.py"), stage));
  return ran.text;
}

TEST(ReferenceNetlistsRtl, PassTheTestBench) {
  const std::string said =
      simulated_netlist("uniqueness", "-s matching.parallelism=4 -s matching.iterations=3");
  EXPECT_EQ(said.rfind("PASS ", 0), 0U) << said;
}

// In Icarus it takes minutes. Verilator 5.006 ends with an error of its own in the gates of another netlist,
// without -fno-gate.
TEST(ReferenceNetlistsRtl, CensusPassesInVerilator) {
  const Program program;
  const Outcome written = program("vectors --stage census --size 32x16 -d 32 --out v -q");
  ASSERT_EQ(written.code, 0) << written.err;
  const Ended ran = shell(program, script("synthesise.py") +
                                       " netlist census-small v/netlist.v && cd v && verilator --binary "
                                       "--timing -fno-gate -Wno-fatal -Wno-lint "
                                       "-CFLAGS -O0 --top-module census_tb census_tb.sv netlist.v "
                                       "\"$(dirname \"$(readlink -f \"$(command -v "
                                       "yosys)\")\")/../share/yosys/xilinx/cells_sim.v\" >log 2>&1 && "
                                       "obj_dir/Vcensus_tb +seed=2");
  EXPECT_EQ(ran.text.rfind("PASS ", 0), 0U) << ran.text;
}

TEST(ReferenceNetlistsRtl, HaveTheRecordedCells) {
  const Program program;
  const Ended checked = shell(program, script("synthesise.py") + " check uniqueness-small");
  EXPECT_EQ(checked.code, 0) << checked.text;
}

TEST(ReferenceNetlistsRtl, BrokenCircuitsAreFound) {
  const Program program;
  const Ended found = shell(program, fmt::format("{} '{}' --of 13 subpixel uniqueness noise_reduction",
                                                 script("mutate.py"), program_path()));
  EXPECT_EQ(found.code, 0) << found.text;
  EXPECT_NE(found.text.find("mutants              5\nfound                5\n"), std::string::npos)
      << found.text;
}

}  // namespace reference_netlists_rtl_test
}  // namespace parallax::test
