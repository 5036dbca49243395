// SPDX-License-Identifier: Apache-2.0
// Which bits of which pin are what: parts of buses, handshakes that ports share, padded AXI streams.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

#include "tests/cli/program.hpp"
#include "tests/cosim/make_cpp_circuit.hpp"

namespace parallax::test {
namespace circuit_pins_test {

constexpr const char* kCensus =
    "run --size 32x16 --timing-frames 1 --no-verdict -s census.window_width=3 -s census.window_height=1 "
    "--circuit census=circuit.so ";

// A census of 3x1 pixels of two images at once: code i of pixel i is there when the next pixel pair comes.
const std::string kRowCensus = R"(
  static unsigned past[2], here[2];
  static bool starts = false, ends = false;
  static unsigned beat = 0;
  ready_o = beat % 3 != 0;
  if (!rises) return;
  ++beat;
  const bool take = valid_in && (kHasReady ? ready_o : true);
  const unsigned next[2] = {unsigned(pixels & 255), unsigned(pixels >> 8 & 255)};
  const bool sof = pixels >> 16 & 1, last = pixels >> 17 & 1;
  valid_out = take;
  codes = 0;
  for (int i = 0; i < 2; ++i)
    codes |= std::uint64_t((!starts && past[i] < here[i]) << 1 | (!ends && next[i] < here[i])) << 2 * i;
  if (!take) return;
  for (int i = 0; i < 2; ++i) past[i] = here[i], here[i] = next[i];
  starts = sof || ends;
  ends = last;
)";
constexpr const char* kBuses =
    "--circuit-pins in_left.data=pixels[7:0] --circuit-pins in_right.data=pixels[15:8] "
    "--circuit-pins in_left.first=pixels[16] --circuit-pins in_right.last=pixels[17] "
    "--circuit-pins out_left.data=codes[1:0] --circuit-pins out_right.data=codes[3:2] "
    "--circuit-flush 1 --circuit-skip 1 ";

class CircuitPins : public ::testing::Test {
 protected:
  void make_census(bool has_ready, const std::string& more = "") const {
    make_cpp_circuit(
        program, "circuit",
        std::string("IN(clk, 1) IN(pixels, 18) IN(valid_in, 1) OUT(codes, 4) OUT(valid_out, 1) ") +
            (has_ready ? "OUT(ready_o, 1)\nconstexpr bool kHasReady = true;"
                       : "\nstatic int ready_o;\nconstexpr bool kHasReady = false;"),
        kRowCensus + more);
  }
  void expect_equal(const std::string& options) const {
    const Outcome outcome = program(kCensus + std::string(kBuses) + options);
    EXPECT_EQ(outcome.code, 0) << outcome.err << outcome.out;
    EXPECT_NE(outcome.out.find("left_codes: equal, 512 tokens"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("right_codes: equal, 512 tokens"), std::string::npos) << outcome.out;
  }

  const Program program;
};

// Each side of each port is stalled by itself: without the other, no token may pass.
TEST_F(CircuitPins, PortsThatShareValidPassTogether) {
  make_census(false);
  expect_equal("");
  expect_equal("--circuit-stall 400");
  expect_equal("--circuit-stall 300 --circuit-seed 7");
}

TEST_F(CircuitPins, PortsThatShareReadyPassTogether) {
  make_census(true);
  expect_equal("");
  expect_equal("--circuit-stall 400");
}

// A pin that the user sets is not found by its name.
TEST_F(CircuitPins, WhatIsSetIsNotDriven) {
  make_cpp_circuit(program, "circuit",
                   "IN(clk, 1) IN(din, 12) IN(din_valid, 1) IN(din_sof, 1) OUT(dout, 12) OUT(dout_valid, 1)",
                   "dout = din_sof ? 1 : din; dout_valid = din_valid;");
  const std::string run =
      "run --size 32x16 --timing-frames 1 --no-verdict -s noise_reduction.enabled=false --circuit "
      "noise_reduction=circuit.so ";
  EXPECT_EQ(program(run).code, 1) << "a start of frame came";
  EXPECT_EQ(program(run + "--circuit-set din_sof=0").code, 0);
  // As the circuit calls them.
  EXPECT_EQ(
      program(run + "--circuit-set din_sof=0 --circuit-pins in.data=din --circuit-pins din.vld=din_valid")
          .code,
      0);
}

// A circuit that needs an edge of its own between tokens has it also where its clock stood in the meantime.
TEST_F(CircuitPins, AnIntervalIsOfTheCircuitsEdges) {
  make_census(false, R"(
  static unsigned last_beat = 0;
  if (beat - last_beat < 2) codes ^= 1;
  last_beat = beat;
)");
  const Outcome outcome = program(kCensus + std::string(kBuses));
  EXPECT_EQ(outcome.code, 1) << outcome.err << outcome.out;
  expect_equal("--circuit-interval 2");
  expect_equal("--circuit-interval 2 --circuit-stall 300");
  expect_equal("--circuit-interval 2 --circuit-stall 300 -s streams.left_codes.depth=1");
}

// More zeros behind each frame than it needs push out results that belong to none.
TEST_F(CircuitPins, ResultsBehindAFrameAreCounted) {
  make_census(false);
  const std::string frames = "--timing-frames 3 --circuit-flush ";
  const auto told = [&](const std::string& options) {
    const Outcome outcome = program(kCensus + std::string(kBuses) + options);
    EXPECT_EQ(outcome.code, 0) << outcome.err << outcome.out;
    EXPECT_NE(outcome.out.find("left_codes: equal, 512 tokens"), std::string::npos) << outcome.out;
    const std::size_t note = outcome.out.find("note  ");
    return note == std::string::npos ? ""
                                     : outcome.out.substr(note, outcome.out.find("left_codes: equal") - note);
  };
  const auto note = [](const std::string& number, const std::string& zeros) {
    const auto line = [&](const std::string& stream) {
      return "note                " + stream + ": " + number + " behind the last one of a frame, of " +
             zeros + " tokens of zeros behind each; --circuit-flush says how many\n";
    };
    return line("left_codes") + line("right_codes");
  };
  EXPECT_EQ(told(frames + "1"), "");
  EXPECT_EQ(told("--circuit-flush 2"), note("1 result", "2"));
  EXPECT_EQ(told(frames + "5"), note("12 results", "5"));
  EXPECT_EQ(told(frames + "5 --circuit-stall 300"), note("12 results", "5"));
  // Without valid, results are counted from the latency on.
  const std::string no_valid =
      "--circuit-pins out_left.valid= --circuit-pins out_right.valid= --circuit-skip 0 ";
  EXPECT_EQ(told(no_valid + "--circuit-latency 2 --circuit-flush 2"), "");
  EXPECT_EQ(told(no_valid + "--circuit-latency 2 --circuit-flush 4"), note("2 results", "4"));
}

// What is left out in front of a frame is missing at its end.
TEST_F(CircuitPins, SkippedResultsNeedZerosBehindAFrame) {
  make_census(false);
  const Outcome outcome = program(kCensus + std::string(kBuses) + "--circuit-flush 0 --circuit-timeout 2000");
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_NE(outcome.out.find("note                left_codes: 1 token too few, as --circuit-skip 1 drops as "
                             "many of each frame or tile; --circuit-flush 1 sends zeros behind it that push "
                             "its last ones out\n"),
            std::string::npos)
      << outcome.out;
  // Without skipping, a frame that ends early has another reason.
  const Outcome other = program(kCensus + std::string(kBuses) +
                                "--circuit-flush 0 --circuit-skip 0 --circuit-set valid_in=0 "
                                "--circuit-pins in_left.valid= --circuit-pins in_right.valid= "
                                "--circuit-timeout 2000");
  EXPECT_EQ(other.out.find("too few, as"), std::string::npos) << other.out;
}

// Of 12 bits in a stream of whole bytes the others are nobody's.
TEST_F(CircuitPins, AnAxiStreamIsWholeBytes) {
  make_cpp_circuit(program, "circuit",
                   "IN(aclk, 1) IN(s_axis_tdata, 16) IN(s_axis_tvalid, 1) OUT(s_axis_tready, 1) "
                   "OUT(m_axis_tdata, 16) OUT(m_axis_tvalid, 1) IN(m_axis_tready, 1)",
                   "m_axis_tdata = s_axis_tdata | 0xf000; m_axis_tvalid = s_axis_tvalid;\n"
                   "s_axis_tready = m_axis_tready;\n"
                   "if (s_axis_tdata >> 12) ended = true;");
  ASSERT_EQ(program("vectors --stage noise_reduction --size 32x16 --out v").code, 0);
  const Outcome outcome =
      program("run --size 32x16 --timing-frames 1 --no-verdict --json --circuit noise_reduction=circuit.so");
  ASSERT_EQ(outcome.code, 1) << "it reduces no noise: " << outcome.err;
  const nlohmann::json stream = nlohmann::json::parse(outcome.out).at("circuits").at(0).at("streams").at(0);
  EXPECT_EQ(stream.at("got_tokens"), 512);
  const nlohmann::json first = stream.at("first_difference");
  const std::string passed =
      lines(program.read("v/interpolated.memh")).at(first.at("token").get<std::size_t>());
  EXPECT_EQ(first.at("got"), std::to_string(std::stoi(passed, nullptr, 16)));
}

// Padded to 16 bits each, and found by the port's name: lowest.v of the guide, with fields apart.
TEST_F(CircuitPins, FieldsMayLieApart) {
  make_cpp_circuit(program, "circuit", "IN(in_costs, 64) OUT(out_disparity, 12)",
                   "unsigned best = 0;\n"
                   "const auto cost = [](unsigned i) { return in_costs >> 16 * i & 2047; };\n"
                   "for (unsigned i = 1; i < 4; ++i) if (cost(i) < cost(best)) best = i;\n"
                   "out_disparity = best << 4;");
  const std::string run =
      "run --size 32x16 --timing-frames 1 --no-verdict -s matching.parallelism=4 -s matching.iterations=1 "
      "-s subpixel.curve=none -s subpixel.mask_border=false --circuit subpixel=circuit.so ";
  const Outcome whole = program(run);
  EXPECT_EQ(whole.code, 2) << whole.out;
  EXPECT_EQ(
      whole.err,
      "parallax: error: circuit circuit: pin in_costs has 64 bits; as in_costs.data it must have 44: 4 x "
      "11, cost_0 lowest; fields that lie otherwise: --circuit-pins in_costs.cost_1=in_costs[26:16] "
      "...\n");
  std::string fields =
      "--circuit-set in_costs[15:11]=0 --circuit-set in_costs[31:27]=0 "
      "--circuit-set in_costs[47:43]=0 --circuit-set in_costs[63:59]=0 ";
  for (int i = 0; i < 3; ++i)
    fields += fmt::format("--circuit-pins in_costs.cost_{}=in_costs[{}:{}] ", i, 16 * i + 10, 16 * i);
  const Outcome three = program(run + fields);
  EXPECT_EQ(three.code, 2) << three.out;
  EXPECT_NE(three.err.find(": subpixel has no pin for in_costs.cost_3 (11 bits), such as in_costs_cost_3; "
                           "nothing drives the input in_costs[58:48] (11 bits); "),
            std::string::npos)
      << three.err;
  const Outcome four = program(run + fields + "--circuit-pins in_costs.cost_3=in_costs[58:48]");
  EXPECT_EQ(four.code, 0) << four.err << four.out;
  EXPECT_NE(four.out.find("winners: equal, 512 tokens"), std::string::npos) << four.out;
}

struct Refused {
  const char* name;
  const char* options;
  const char* message;
};

void PrintTo(const Refused& refused, std::ostream* out) { *out << refused.name; }

class CircuitPinsRefused : public ::testing::TestWithParam<Refused> {};

TEST_P(CircuitPinsRefused, InOneLine) {
  const Program program;
  make_cpp_circuit(program, "circuit",
                   "IN(clk, 1) IN(pixels, 18) IN(valid_in, 1) OUT(codes, 4) OUT(valid_out, 1)", "");
  const Outcome outcome =
      program(kCensus +
              std::string("--circuit-pins in_left.data=pixels[7:0] --circuit-pins out_left.data=codes[1:0] "
                          "--circuit-pins out_right.data=codes[3:2] ") +
              GetParam().options);
  EXPECT_EQ(outcome.code, 2) << outcome.out;
  EXPECT_EQ(outcome.err, std::string("parallax: error: ") + GetParam().message + "\n");
}

INSTANTIATE_TEST_SUITE_P(
    All, CircuitPinsRefused,
    ::testing::Values(
        Refused{"NoRange", "--circuit-pins in_right.data=pixels[8:15]",
                "--circuit-pins in_right.data=pixels[8:15]: a pin is PIN, PIN[BIT] or PIN[HIGH:LOW]"},
        Refused{"NotClosed", "--circuit-pins in_right.data=pixels[15:8",
                "--circuit-pins in_right.data=pixels[15:8: a pin is PIN, PIN[BIT] or PIN[HIGH:LOW]"},
        Refused{
            "Beyond", "--circuit-pins in_right.data=pixels[18:11]",
            "--circuit-pins in_right.data=pixels[18:11]: pin pixels of circuit circuit has the bits 17 to 0"},
        Refused{"NoPin", "--circuit-pins in_right.data=pixel[15:8]",
                "--circuit-pins in_right.data=pixel[15:8]: circuit circuit has no such pin; the nearest is "
                "pixels"},
        Refused{"Width", "--circuit-pins in_right.data=pixels[14:8]",
                "circuit circuit: pin pixels[14:8] has 7 bits; as in_right.data it must have 8"},
        Refused{"Undriven", "--circuit-pins in_right.data=pixels[15:8]",
                "circuit circuit: nothing drives the input pixels[17:16] (2 bits); --circuit-pins "
                "ROLE=pixels[17:16] says what it is, --circuit-set pixels[17:16]=VALUE what it is to be"},
        Refused{"Constant", "--circuit-pins in_right.data=pixels[15:8] --circuit-set pixels[17:16]=4",
                "--circuit-set pixels[17:16]=4: pin pixels[17:16] has 2 bits, which do not hold it"},
        Refused{"TwoRolesOfOnePin", "--circuit-pins in_right.data=pixels[7:0]",
                "circuit circuit: pin pixels[7:0] is in_left.data and in_right.data; --circuit-pins ROLE=PIN "
                "gives each its own"},
        Refused{"OneRoleTwice", "--circuit-pins in_left.tdata=pixels[15:8]",
                "--circuit-pins: in_left.data is given twice"},
        Refused{"SetAndDriven", "--circuit-pins in_right.data=pixels[15:8] --circuit-set pixels[8]=1",
                "circuit circuit: pin pixels[15:8] is --circuit-set pixels[8]=1 and in_right.data; "
                "--circuit-pins ROLE=PIN gives each its own"},
        Refused{
            "ClockThatIsSet",
            "--circuit-pins in_right.data=pixels[15:8] --circuit-set pixels[17:16]=0 --circuit-set clk=0",
            "circuit circuit has no clock, such as clk, but a handshake at in_left; --circuit-pins clock=PIN "
            "names it"},
        Refused{"Output", "--circuit-pins in_right.data=pixels[15:8] --circuit-set codes[1:0]=1",
                "--circuit-set codes[1:0]=1: pin codes of circuit circuit is an output"}),
    [](const auto& each) { return std::string(each.param.name); });

}  // namespace circuit_pins_test
}  // namespace parallax::test
