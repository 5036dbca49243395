// SPDX-License-Identifier: Apache-2.0
// Circuits in the place of a stage of the machine: what a run says of their values, their dates and their
// handshake.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>
#include <string>

#include "tests/cli/program.hpp"
#include "tests/paths.hpp"

namespace parallax::test {
namespace circuit_rtl_test {

constexpr const char* kMachine = "run --size 64x48 --no-verdict --timing-frames 1 ";

std::string rtl(const std::string& name) { return source_path("tests/rtl/" + name); }

// With a fault of census_5x5.sv, or none.
std::string census(const Program& program, const std::string& fault = "") {
  std::ifstream in(rtl("census_5x5.sv"));
  std::ofstream out(program / "census.sv");
  if (!fault.empty()) out << "`define " << fault << "\n";
  out << in.rdbuf();
  return "--circuit census=census.sv ";
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t number = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++number;
  return number;
}

TEST(CircuitRun, ACircuitThatIsRightIsEqualAtOtherDates) {
  const Program program;
  const Outcome outcome = program(kMachine + census(program));
  EXPECT_EQ(outcome.code, 0) << outcome.err << outcome.out;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(count(outcome.out, "codes: equal, 3072 tokens\n"), 2U) << outcome.out;
  // The model's stage has a latency of 4 cycles, this one of 2.
  EXPECT_EQ(count(outcome.out, "each at least 2 cycles earlier than the model\n"), 2U) << outcome.out;
}

TEST(CircuitRun, TheRestOfTheMachineGoesOnWithIts) {
  const Program program;
  ASSERT_EQ(program(std::string(kMachine) + "--out model -q").code, 0);
  ASSERT_EQ(program(kMachine + census(program) + "--out circuit -q").code, 0);
  EXPECT_EQ(program.read("model/disparity.png"), program.read("circuit/disparity.png"));
  ASSERT_EQ(program(kMachine + census(program, "FAULT_BORDER") + "--out wrong -q").code, 1);
  EXPECT_NE(program.read("model/disparity.png"), program.read("wrong/disparity.png"));
}

TEST(CircuitRun, StallsChangeDatesAlone) {
  const Program program;
  const Outcome outcome = program(kMachine + census(program) + "--circuit-stall 400 --circuit-seed 5 --json");
  EXPECT_EQ(outcome.code, 0) << outcome.err << outcome.out;
  const nlohmann::json circuit = nlohmann::json::parse(outcome.out).at("circuits").at(0);
  EXPECT_TRUE(circuit.at("as_model").get<bool>());
  EXPECT_GT(circuit.at("streams").at(0).at("latest").at("cycles").get<int>(), 0);
}

// Two of which the second has a stage between that works on whole rows.
class CircuitPair : public ::testing::Test {
 protected:
  // The options of both, the second one first.
  std::string pair(const std::string& unpack_fault, const std::string& census_fault) const {
    std::ifstream in(source_path("tests/package/own_circuit.sv"));
    std::string text{std::istreambuf_iterator<char>(in), {}};
    if (!unpack_fault.empty()) {
      const std::string right = "out_tokens_data = ";
      text.insert(text.find(right) + right.size(), unpack_fault);
    }
    std::ofstream(program / "unpack.sv") << text;
    return census(program, census_fault) + "--circuit unpack_left=unpack.sv --circuit-define LAST=127 " +
           "--circuit-include " + source_path("tests/package/include") + " ";
  }
  nlohmann::json circuits(const Outcome& outcome) const {
    return nlohmann::json::parse(outcome.out).at("circuits");
  }
  static bool equal(const nlohmann::json& circuit) { return circuit.at("as_model").get<bool>(); }

  const Program program;
};

TEST_F(CircuitPair, IsAsTheModelUnderStalls) {
  const Outcome outcome = program(kMachine + pair("", "") + "--circuit-stall 300 --json");
  EXPECT_EQ(outcome.code, 0) << outcome.err << outcome.out;
  const nlohmann::json told = circuits(outcome);
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0].at("stage"), "unpack_left");  // upstream first
  EXPECT_EQ(told[1].at("stage"), "census");
  EXPECT_TRUE(equal(told[0]) && equal(told[1])) << told.dump();
}

TEST_F(CircuitPair, TheSecondGetsWhatTheFirstMakes) {
  ASSERT_EQ(program(std::string(kMachine) + "--out model -q").code, 0);
  const Outcome outcome = program(kMachine + pair("~", "") + "--json --out wrong");
  EXPECT_EQ(outcome.code, 1);
  const nlohmann::json told = circuits(outcome);
  EXPECT_FALSE(equal(told[0]));
  EXPECT_TRUE(equal(told[1])) << "it does as the model does with these tokens: " << told[1].dump();
  EXPECT_NE(program.read("model/disparity.png"), program.read("wrong/disparity.png"));
}

TEST_F(CircuitPair, AsShadowsEachStandsAlone) {
  ASSERT_EQ(program(std::string(kMachine) + "--out model -q").code, 0);
  const Outcome outcome =
      program(kMachine + pair("~", "FAULT_BORDER") + "--circuit-shadow --json --out beside");
  EXPECT_EQ(outcome.code, 1);
  const nlohmann::json told = circuits(outcome);
  EXPECT_EQ(told[0].at("streams").at(0).at("patterns").at(0).at("name"), "inverted");
  EXPECT_EQ(told[1].at("streams").at(0).at("patterns").at(0).at("name"), "only_rim");
  EXPECT_EQ(program.read("model/disparity.png"), program.read("beside/disparity.png"));
}

TEST(CircuitRun, BehindOneThatIsGivenUpTheNextIsLeftOut) {
  const Program program;
  std::ofstream(program / "none.sv")
      << "module none(input clk, input rst, input [11:0] in_disparity_data, input in_disparity_valid,\n"
         "  output in_disparity_ready, output [11:0] out_disparity_data, output out_disparity_valid,\n"
         "  input out_disparity_ready);\n  assign in_disparity_ready = out_disparity_ready;\n"
         "  assign out_disparity_valid = in_disparity_valid, out_disparity_data = in_disparity_data;\n"
         "endmodule\n";
  const Outcome outcome =
      program(kMachine + census(program, "FAULT_HANGS") + "--circuit noise_reduction=none.sv");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(count(outcome.out,
                  "circuit             none is left out: the circuit of census before it was given up\n"),
            1U)
      << outcome.err << outcome.out;
}

// A circuit without Verilog: a disparity passes in the cycle in which it comes, as ready does.
void make_wires(const Program& program) {
  std::ofstream(program / "wires.c")
      << "#include <stdlib.h>\n#include \"circuit.h\"\n"
         "struct wires { unsigned char clk, rst, in_valid, in_ready, out_valid, out_ready, in[2], out[2];\n"
         "  struct parallax_pin pins[8]; };\n"
         "static void* make(unsigned seed) {\n"
         "  struct wires* w = calloc(1, sizeof *w);\n"
         "  const struct parallax_pin pins[8] = {{\"clk\", 1, 1, &w->clk}, {\"rst\", 1, 1, &w->rst},\n"
         "    {\"in_disparity_data\", 1, 12, w->in}, {\"in_disparity_valid\", 1, 1, &w->in_valid},\n"
         "    {\"in_disparity_ready\", 0, 1, &w->in_ready}, {\"out_disparity_data\", 0, 12, w->out},\n"
         "    {\"out_disparity_valid\", 0, 1, &w->out_valid}, {\"out_disparity_ready\", 1, 1, "
         "&w->out_ready}};\n"
         "  (void)seed;\n"
         "  for (int i = 0; i < 8; ++i) w->pins[i] = pins[i];\n"
         "  return w;\n}\n"
         "static const struct parallax_pin* pins(void* w, unsigned* n) {\n"
         "  return *n = 8, ((struct wires*)w)->pins;\n}\n"
         "static void evaluate(void* c) {\n"
         "  struct wires* w = c;\n"
         "  w->out[0] = w->in[0], w->out[1] = w->in[1], w->out_valid = w->in_valid, w->in_ready = "
         "w->out_ready;\n}\n"
         "static int finished(void* w) { return (void)w, 0; }\n"
         "static const struct parallax_circuit wires = {PARALLAX_CIRCUIT_VERSION, \"wires\", make, pins, "
         "evaluate,\n"
         "  finished, free};\n"
         "const struct parallax_circuit* parallax_get_circuit(void) { return &wires; }\n";
  const std::string build = "cd '" + program.folder().path().string() + "' && cc -shared -fPIC -I" +
                            source_path("platform/cosim/circuit") + " wires.c -o wires.so";
  ASSERT_EQ(std::system(build.c_str()), 0);
}

constexpr const char* kTwoWires =
    "--circuit gap_interpolation=wires.so --circuit noise_reduction=wires.so "
    "--set gap_interpolation.enabled=false --set noise_reduction.enabled=false "
    "--set streams.interpolated.kind=free ";

TEST(CircuitRun, BetweenTwoCircuitsReadyIsNotCombinational) {
  const Program program;
  make_wires(program);
  const std::string two = kMachine + std::string(kTwoWires);
  const Outcome refused = program(two + "--set streams.interpolated.read_to_write=0");
  EXPECT_EQ(refused.code, 2) << refused.out;
  EXPECT_EQ(
      refused.err,
      "parallax: error: streams.interpolated.read_to_write = 0: between the circuits of gap_interpolation "
      "and noise_reduction no place can be freed and taken in one cycle; 1 or more can be kept, or any "
      "with --circuit-shadow\n");
  for (const char* allowed :
       {"--set streams.interpolated.read_to_write=1", "--set streams.interpolated.write_to_read=0",
        "--set streams.interpolated.read_to_write=0 --circuit-shadow",
        "--set streams.smoothed.kind=free --set streams.smoothed.read_to_write=0"}) {
    const Outcome outcome = program(two + allowed);
    EXPECT_EQ(outcome.code, 0) << allowed << "\n" << outcome.err << outcome.out;
    EXPECT_EQ(count(outcome.out, "equal says little   the stage changes 0 of "), 2U) << outcome.out;
  }
}

// Of a reset that forgets a register, the seed decides what is in it.
TEST(CircuitRun, ARegisterBeginsAtRandom) {
  const Program program;
  std::ofstream(program / "c.sv")
      << "module c(input clk, input rst, input [11:0] in_data, input in_valid, output in_ready,\n"
         "  output [11:0] out_data, output out_valid, input out_ready);\n"
         "  reg [11:0] forgotten;\n  assign out_data = forgotten, out_valid = in_valid, in_ready = "
         "out_ready;\n"
         "  always @(posedge clk) if (rst && in_data == 12'hfff) forgotten <= in_data;\nendmodule\n";
  ASSERT_EQ(program("circuit c.sv --out c.so").code, 0);
  std::set<std::string> begins;
  for (const char* const seed : {"1", "2", "3", "4"}) {
    const Outcome outcome =
        program(std::string(kMachine) + "--json --circuit noise_reduction=c.so --circuit-seed " + seed);
    const nlohmann::json stream = nlohmann::json::parse(outcome.out).at("circuits").at(0).at("streams").at(0);
    begins.insert(stream.at("first_difference").at("got").get<std::string>());
  }
  EXPECT_GE(begins.size(), 2U);
}

// Verilator would evaluate it for ever, with a line each time.
TEST(CircuitRun, ALoopThatDoesNotSettleEndsIt) {
  const Program program;
  std::ofstream(program / "loop.sv")
      << "module loop(input [11:0] in_data, output [11:0] out_data);\n"
         "  wire a;\n  assign a = ~a, out_data = in_data ^ {12{a}};\nendmodule\n";
  const Outcome outcome = program(std::string(kMachine) + "--circuit noise_reduction=loop.sv");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("did not converge"), std::string::npos) << outcome.err;
  EXPECT_EQ(count(outcome.err, "\n"), 2U) << outcome.err;
  EXPECT_EQ(count(outcome.out, "given up            it has ended the simulation"), 1U) << outcome.out;
}

struct Fault {
  const char* name;
  const char* said;  // by the run, of what differs
};

void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

class CircuitFault : public ::testing::TestWithParam<Fault> {};

TEST_P(CircuitFault, IsFoundAndNamed) {
  const Program program;
  const Outcome outcome = program(kMachine + census(program, GetParam().name));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.out.find(GetParam().said), std::string::npos) << outcome.err << outcome.out;
}

INSTANTIATE_TEST_SUITE_P(
    All, CircuitFault,
    ::testing::Values(
        Fault{"FAULT_BORDER", "pattern             only the rim differs, 2 px wide\n"},
        Fault{"FAULT_CHANGED",
              "handshake           left_codes: the data change before token 639 was taken, in "},
        Fault{"FAULT_HANGS",
              "since cycle 111025: left_texture is full (streams.left_texture.depth = 327) and rectification "
              "waits for room in it; left_rectified has no token (token 1200 of frame 0"},
        Fault{"FAULT_LOST", "pattern             token 640 (frame 0, row 10, column 0) is lost"},
        Fault{
            "FAULT_WITHDRAWN",
            "handshake           left_codes: valid goes from 1 to 0 before token 639 was taken, in cycle "}),
    [](const auto& each) { return std::string(each.param.name); });

// What is wrong before anything runs.
struct Refused {
  const char* name;
  const char* arguments;
  const char* message;
};

void PrintTo(const Refused& refused, std::ostream* out) { *out << refused.name; }

class CircuitRefused : public ::testing::TestWithParam<Refused> {};

TEST_P(CircuitRefused, InOneLine) {
  const Program program;
  std::ofstream(program / "no.so") << "nothing";
  std::ofstream(program / "wrong.sv") << "module wrong; endmodul\n";
  std::ofstream(program / "narrow.sv")
      << "module narrow(input clk, input rst, input [7:0] in_disparity_data, input in_disparity_valid,\n"
         "  output in_disparity_ready, output [10:0] out_disparity_data, output out_disparity_valid,\n"
         "  input out_disparity_ready, input mode);\nendmodule\n";
  const Outcome outcome = program(kMachine + std::string(GetParam().arguments));
  EXPECT_EQ(outcome.code, 2) << outcome.out;
  EXPECT_EQ(outcome.err.rfind(std::string("parallax: error: ") + GetParam().message, 0), 0U) << outcome.err;
  EXPECT_EQ(count(outcome.err, "\n"), 1U) << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(
    All, CircuitRefused,
    ::testing::Values(
        Refused{"NoStage", "--circuit census.sv", "--circuit: 'census.sv' is not STAGE=FILE[,FILE...], as "},
        Refused{"NoFile", "--circuit census=none.sv", "--circuit: none.sv is no file"},
        Refused{"NoLibrary", "--circuit census=no.so", "circuit "},
        Refused{"Verilog", "--circuit census=wrong.sv", "verilator: %Error: wrong.sv:1:"},
        Refused{"Width", "--circuit noise_reduction=narrow.sv",
                "circuit narrow: pin in_disparity_data has 8 bits; as in_disparity.data it must have 12"},
        Refused{"Twice", "--circuit census=a.sv --circuit census=b.sv",
                "--circuit: census is given twice; one circuit stands for it"},
        Refused{"Nothing", "--circuit-latency 3", "--circuit-latency requires --circuit"},
        Refused{"WavesNowhere", "--circuit census=wrong.sv --circuit-waves 3",
                "--circuit-waves needs --out: the folder that the waves are written to"},
        Refused{"NoShadow", "--circuit-shadow", "--circuit-shadow requires --circuit"},
        Refused{"Parameter", "--circuit census=wrong.sv --circuit-parameter WIDTH",
                "--circuit-parameter: 'WIDTH' is not NAME=VALUE, as WIDTH=640"}),
    [](const auto& each) { return std::string(each.param.name); });

}  // namespace circuit_rtl_test
}  // namespace parallax::test
