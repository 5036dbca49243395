// SPDX-License-Identifier: Apache-2.0
// What a run says of a circuit that does not fit its stage, and of one that does not keep the handshake.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

#include "tests/cosim/make_cpp_circuit.hpp"

namespace parallax::test {
namespace circuit_messages_test {

constexpr const char* kMachine = "run --size 32x16 --no-verdict --timing-frames 1 ";
constexpr const char* kPlace = "--circuit noise_reduction=c.so ";

// With ready and valid, and what each case changes of it.
constexpr const char* kInput = "IN(clk, 1) IN(in_valid, 1) IN(in_data, 12) OUT(in_ready, 1) ";
constexpr const char* kOutput = "OUT(out_valid, 1) OUT(out_data, 12) IN(out_ready, 1) ";
std::string both(const std::string& more = "") { return std::string(kInput) + kOutput + more; }

void expect_refused(const Outcome& outcome, const std::string& message) {
  EXPECT_EQ(outcome.code, 2) << outcome.out;
  EXPECT_EQ(outcome.err, "parallax: error: " + message + "\n");
}

struct Misfit {
  const char* name;
  std::string pins;
  const char* arguments;
  const char* message;
};

void PrintTo(const Misfit& misfit, std::ostream* out) { *out << misfit.name; }

class CircuitMisfit : public ::testing::TestWithParam<Misfit> {};

TEST_P(CircuitMisfit, IsRefusedInOneLine) {
  const Program program;
  make_cpp_circuit(program, "c", GetParam().pins, "");
  expect_refused(program(std::string(kMachine) + kPlace + GetParam().arguments), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    All, CircuitMisfit,
    ::testing::Values(
        Misfit{"NoInput", "IN(clk, 1) IN(pixel, 12) " + std::string(kOutput), "",
               "circuit circuit: noise_reduction has no pin for in_disparity.data (12 bits), such as "
               "in_disparity_data; nothing drives the input pixel (12 bits); --circuit-pins "
               "in_disparity.data=PIN names it; --circuit-pins ROLE=pixel says what it is, --circuit-set "
               "pixel=VALUE what it is to be"},
        Misfit{
            "NoOutput", kInput, "",
            "circuit circuit: noise_reduction has no pin for out_disparity.data (12 bits), such as "
            "out_disparity_data; no other output is there; --circuit-pins out_disparity.data=PIN names it"},
        Misfit{"AllAtOnce", "IN(clk, 1) IN(pixel, 12) IN(mode, 3) IN(go, 1) OUT(flat, 12) OUT(busy, 1)",
               "--circuit-set mode[1]=0",
               "circuit circuit: noise_reduction has no pin for in_disparity.data (12 bits), "
               "out_disparity.data (12 bits), such as in_disparity_data; nothing drives the inputs pixel (12 "
               "bits), mode[0] (1 bit), mode[2] (1 bit), go (1 bit); nothing reads the outputs flat (12 "
               "bits), busy (1 bit); --circuit-pins in_disparity.data=PIN names it; --circuit-pins "
               "ROLE=pixel says what it is, --circuit-set pixel=VALUE what it is to be"},
        Misfit{"NoInputAtAll", "IN(clk, 1) " + std::string(kOutput), "",
               "circuit circuit: noise_reduction has no pin for in_disparity.data (12 bits), such as "
               "in_disparity_data; no other input is there; --circuit-pins in_disparity.data=PIN names it"},
        Misfit{"InputAsOutput", "IN(clk, 1) OUT(in_data, 12) " + std::string(kOutput), "",
               "circuit circuit: pin in_data is an output; as in_disparity.data it must be an input"},
        Misfit{"OutputAsInput", std::string(kInput) + "IN(out_data, 12)", "",
               "circuit circuit: pin out_data is an input; as out_disparity.data it must be an output"},
        Misfit{"Width", "IN(clk, 1) IN(in_data, 12) IN(in_valid, 2) " + std::string(kOutput), "",
               "circuit circuit: pin in_valid has 2 bits; as in_disparity.valid it must have 1"},
        Misfit{"Undriven", both("IN(mode, 3)"), "",
               "circuit circuit: nothing drives the input mode (3 bits); --circuit-pins ROLE=mode says what "
               "it is, --circuit-set mode=VALUE what it is to be"},
        Misfit{"NoClock", "IN(in_valid, 1) IN(in_data, 12) OUT(out_data, 12)", "",
               "circuit circuit has no clock, such as clk, but a handshake at in_disparity; --circuit-pins "
               "clock=PIN names it"},
        Misfit{"NarrowColumn", both("IN(in_x, 4)"), "",
               "circuit circuit: pin in_x has 4 bits; as in_disparity.column it must hold 31"},
        Misfit{"NarrowRow", both("IN(in_row, 1)"), "",
               "circuit circuit: pin in_row has 1 bit; as in_disparity.row it must hold 15"},
        Misfit{"NoRole", both(), "--circuit-pins clock",
               "--circuit-pins: 'clock' is not ROLE=PIN, as in_left.data=pixel or clock=clk"},
        Misfit{"NoPin", both(), "--circuit-pins clock=klk",
               "--circuit-pins clock=klk: circuit circuit has no such pin; the nearest is clk"},
        Misfit{"NoSuchPin", both(), "--circuit-pins in_disparity.valid=strobe",
               "--circuit-pins in_disparity.valid=strobe: circuit circuit has no such pin; there are clk, "
               "in_valid, "
               "in_data, in_ready, out_valid, out_data, out_ready"},
        Misfit{"NoPinOfARole", both(), "--circuit-pins in_disparity.valid=",
               "circuit circuit: nothing drives the input in_valid (1 bit); --circuit-pins ROLE=in_valid "
               "says what "
               "it is, --circuit-set in_valid=VALUE what it is to be"},
        Misfit{"NoRoleOfThePort", both(), "--circuit-pins valid_in=",
               "--circuit-pins valid_in=: noise_reduction has no such role; there are clock, reset, reset_n, "
               "in_disparity.data, in_disparity.valid, in_disparity.ready, in_disparity.first, "
               "in_disparity.last, "
               "in_disparity.keep, in_disparity.row, in_disparity.column, in_disparity.group, "
               "in_disparity.line_valid, in_disparity.frame_valid, out_disparity.data, "
               "out_disparity.valid, out_disparity.ready, out_disparity.first, out_disparity.last, enable"},
        Misfit{"UnknownRole", both(), "--circuit-pins in_disparity.date=in_data",
               "--circuit-pins in_disparity.date=in_data: noise_reduction has no such role; the nearest is "
               "in_disparity.data"},
        Misfit{"LatencyWithValid", both(), "--circuit-latency 3",
               "--circuit-latency 3: circuit circuit says itself when a result is there, by out_valid; leave "
               "it out, "
               "or --circuit-pins out_disparity.valid= has it count edges; --circuit-flush sends tokens "
               "behind a "
               "frame"},
        Misfit{"SetNothing", both("IN(mode, 3)"), "--circuit-set mode",
               "--circuit-set: 'mode' is not PIN=VALUE, decimal or 0x, as threshold=12"},
        Misfit{"SetNoNumber", both("IN(mode, 3)"), "--circuit-set mode=0xg",
               "--circuit-set: 'mode=0xg' is not PIN=VALUE, decimal or 0x, as threshold=12"},
        Misfit{"SetNoPin", both("IN(mode, 3)"), "--circuit-set mod=1",
               "--circuit-set mod=1: circuit circuit has no such pin; the nearest is mode"},
        Misfit{"SetTooMuch", both("IN(mode, 3)"), "--circuit-set mode=8",
               "--circuit-set mode=8: pin mode has 3 bits, which do not hold it"}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(CircuitLibrary, OfAnotherKindOrVersionIsRefused) {
  const Program program;
  make_library(program, "c", "int nothing;\n");
  expect_refused(program(std::string(kMachine) + kPlace),
                 "c.so is no circuit: it has no function parallax_get_circuit (circuit.h)");
  make_library(program, "c",
               "#define PINS(IN, OUT)\n#define VERSION 7\n#include \"tests/cosim/cpp_circuit.hpp\"\n"
               "static void evaluate(bool) {}\n");
  expect_refused(program(std::string(kMachine) + kPlace),
                 "c.so: a circuit of version 7, this program takes version 1; build it again");
}

TEST(CircuitLibrary, IsMadeOfFilesThatAreThere) {
  const Program program;
  expect_refused(program("circuit none.v --out c.so"), "none.v is no file");
  expect_refused(program(std::string(kMachine) + "--circuit noise_reduction=none.v"),
                 "--circuit: none.v is no file");
}

// Before anything is compiled.
TEST(CircuitLibrary, IsOfAStageOfTheMachine) {
  const Program program;
  expect_refused(program(std::string(kMachine) + "--circuit census=none.v --circuit noise_reducton=c.v"),
                 "--circuit: there is no stage 'noise_reducton'; the nearest of this machine's is "
                 "noise_reduction");
  std::string many;
  for (int i = 0; i < 65; ++i) many += fmt::format("--circuit stage_{}=c.v ", i);
  expect_refused(program(kMachine + many),
                 "--circuit: 65 circuits are too many; at most 64 can be in one machine");
}

struct Breach {
  const char* name;
  const char* body;
  const char* arguments;
  const char* said;
};

void PrintTo(const Breach& breach, std::ostream* out) { *out << breach.name; }

class CircuitBreach : public ::testing::TestWithParam<Breach> {};

// Each passes its tokens on (they are not what the model's stage makes of them) with one fault.
TEST_P(CircuitBreach, IsTold) {
  const Program program;
  make_cpp_circuit(program, "c", both(), GetParam().body);
  const Outcome outcome = program(std::string(kMachine) + GetParam().arguments + kPlace);
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_NE(outcome.out.find(GetParam().said), std::string::npos) << outcome.err << outcome.out;
}

constexpr const char* kThrough = "in_ready = out_ready, out_valid = in_valid, out_data = in_data;\n";

INSTANTIATE_TEST_SUITE_P(
    All, CircuitBreach,
    ::testing::Values(
        Breach{"Surplus",
               "in_ready = out_ready, out_data = in_data;\n static int tokens = 0;\n"
               "tokens += rises && in_valid && out_ready;\n out_valid = in_valid || tokens == 512;\n",
               "", "handshake           smoothed: a token more than the 512 of frame 0, in cycle "},
        Breach{
            "Finish",
            "in_ready = out_ready, out_valid = in_valid, out_data = in_data;\n static int tokens = 0;\n"
            "tokens += rises && in_valid && out_ready;\n ended = tokens == 100;\n",
            "",
            "given up            it has ended the simulation ($finish, $stop or an error of Verilator's) in "
            "cycle "},
        Breach{"TokenFromNowhere", "in_ready = out_ready, out_data = in_data, out_valid = 1;\n", "",
               "handshake           smoothed: a token before one has gone in, in cycle 0\n"},
        Breach{"NeverReady", "", "--circuit-timeout 50 ",
               "given up            nothing has moved at its ports: interpolated offers token 0 of frame 0, "
               "and the circuit is not ready; at smoothed the circuit does not offer token 0 of frame 0\n"
               "smoothed: 0 tokens in place of 512, 512 too few\n"
               "pattern             no token came out\n"},
        Breach{
            "NothingComes", "in_ready = 1;", "--circuit-timeout 2000 ",
            ": interpolated has no token (token 0 of frame 1 comes next); at smoothed the circuit does not "
            "offer token 0 of frame 0\n"},
        Breach{"NoRoom", "in_ready = 1;\n static bool begun = false;\n out_valid = begun |= in_valid != 0;\n",
               "--circuit-stall 990 --circuit-timeout 20 ", "at smoothed there is no room for token "},
        Breach{
            "ValidWaitsForReady",
            "in_ready = out_ready, out_valid = in_valid && out_ready, out_data = in_data;\n",
            "--circuit-stall 300 ",
            "note                smoothed: out_valid waits for out_ready, and is 0 or 1 as it is, in cycle "},
        Breach{"Bound", kThrough, "--circuit-stall 500 --circuit-bound 5 ",
               "                    more than the bound of 5 cycles\n"}),
    [](const auto& each) { return std::string(each.param.name); });

// Holds back 2500 tokens, which those past it have to wait for.
TEST(CircuitStandstill, NamesTheFullFifoBesideIt) {
  const Program program;
  make_cpp_circuit(program, "c", both() + "\n#include <deque>",
                   "static std::deque<std::uint64_t> held;\n static int in = 0;\n"
                   "if (rises && out_valid && out_ready) held.pop_front();\n"
                   "if (rises && in_valid) held.push_back(in_data), ++in;\n"
                   "in_ready = 1, out_valid = !held.empty() && (held.size() > 2500 || in == 64 * 48);\n"
                   "out_data = held.empty() ? 0 : held.front();");
  const std::string larger =
      "run --size 64x48 --no-verdict --timing-frames 1 --circuit noise_reduction=c.so --circuit-timeout "
      "5000 ";
  const Outcome stands = program(larger + "-s streams.left_output.depth=2400");
  EXPECT_EQ(stands.code, 1) << stands.err;
  EXPECT_NE(
      stands.err.find(": left_output is full (streams.left_output.depth = 2400) and rectification waits for "
                      "room in it; interpolated has no token ("),
      std::string::npos)
      << stands.err;
  const Outcome deeper = program(larger + "-s streams.left_output.depth=3072");
  EXPECT_EQ(deeper.code, 1) << "it reduces no noise: " << deeper.err;
  EXPECT_EQ(deeper.out.find("given up"), std::string::npos) << deeper.out;
}

TEST(CircuitStandstill, SaysWhichCircuit) {
  const Program program;
  make_cpp_circuit(program, "c", both(), "in_ready = out_ready, out_valid = in_valid, out_data = in_data;");
  make_cpp_circuit(program, "stuck", both(), "");
  const Outcome outcome = program(
      "run --size 32x16 --no-verdict --timing-frames 1 --circuit-timeout 2000 "
      "--circuit noise_reduction=c.so --circuit gap_interpolation=stuck.so");
  EXPECT_EQ(outcome.code, 1) << outcome.out;
  EXPECT_EQ(
      outcome.err.find("parallax: error: circuit circuit in the place of gap_interpolation was given up: "),
      0U)
      << outcome.err;
  EXPECT_NE(outcome.out.find("is left out: the circuit of gap_interpolation before it was given up\n"),
            std::string::npos)
      << outcome.out;
}

// As an always block that does not end.
TEST(CircuitStandstill, EndsAnEvaluationThatDoesNot) {
  const Program program;
  make_cpp_circuit(
      program, "c", both(),
      "in_ready = out_ready, out_valid = in_valid, out_data = in_data;\n static int tokens = 0;\n"
      "tokens += rises && in_valid && out_ready;\n"
      "for (volatile bool ends = false; tokens == 100 && !ends;) continue;");
  const std::string run = std::string(kMachine) + "--circuit-seconds 1 " + kPlace;
  for (const std::string& options : {std::string(), std::string("--circuit-shadow")}) {
    const Outcome outcome = program(run + options);
    EXPECT_EQ(outcome.code, 1) << outcome.out;
    const std::string begin =
        "parallax: error: circuit circuit in the place of noise_reduction has not come back from cycle ";
    const std::string end =
        " for 1 s, as with an endless loop in an always block; --circuit-seconds says how long it may take\n";
    const std::size_t digits = outcome.err.find_first_not_of("0123456789", begin.size());
    EXPECT_EQ(outcome.err.substr(0, begin.size()), begin);
    EXPECT_EQ(outcome.err.substr(std::min(digits, outcome.err.size())), end);
  }
  make_cpp_circuit(program, "c", both(), "for (volatile bool ends = false; !ends;) continue;");
  EXPECT_NE(program(run).err.find(" has not come back from its reset for 1 s"), std::string::npos);
}

// Of two ports, one has valid by its name.
TEST(CircuitStandstill, TellsOfHalfAHandshake) {
  const Program program;
  const std::string pins = "IN(clk, 1) IN(in_left, 8) IN(in_right, 8) OUT(out_left, 2) OUT(out_right, 2) ";
  const auto told = [&](const std::string& valid, const std::string& body, const std::string& options = "") {
    make_cpp_circuit(program, "c", pins + valid, body);
    const Outcome outcome = program(
        "run --size 32x16 --timing-frames 1 --no-verdict -s census.window_width=3 -s census.window_height=1 "
        "--circuit census=c.so --circuit-timeout 2000 " +
        options);
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    return outcome.out.substr(std::min(outcome.out.find("circuit   "), outcome.out.size()));
  };
  const auto expect_in = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  const std::string input =
      told("IN(in_left_valid, 1) OUT(out_valid, 1)", "if (rises) out_valid = in_left_valid;");
  expect_in(
      input,
      ": its clock stands: in_right has no token, and no valid to say so; left_rectified has no token (");
  expect_in(input, "; at left_codes the circuit offers token 511 of frame 0, and there is no edge; ");
  expect_in(input,
            "note                in_right has no valid, in_left has in_left_valid: --circuit-pins "
            "in_right.valid=in_left_valid, if it is of both\n");
  const std::string output =
      told("IN(in_valid, 1) OUT(out_left_valid, 1)", "if (rises) out_left_valid = in_valid;");
  expect_in(output,
            ": its clock stands: out_right, which has no valid, needs a token at in_left with each edge; ");
  expect_in(output,
            "note                out_right has no valid, out_left has out_left_valid: --circuit-pins "
            "out_right.valid=out_left_valid, if it is of both\n");
  const std::string full =
      told("IN(in_valid, 1) OUT(out_valid, 1)", "static bool any;\n any |= in_valid;\n out_valid = any;",
           "--circuit-timeout 500 --circuit-stall 990");
  expect_in(full, ": its clock stands: out_left has no room, and no ready to say so; ");
}

// Its sums alone do not say which path is wrong.
TEST(CircuitPatterns, OfTheMatcherAreSeenInItsPaths) {
  const Program program;
  make_cpp_circuit(
      program, "c",
      "IN(clk, 1) IN(in_left, 24) IN(in_right, 24) IN(in_valid, 1) OUT(out_costs, 44) OUT(out_valid, 1)",
      "if (!rises) return;\n static std::uint64_t random = 1;\n"
      "out_valid = in_valid, out_costs = (random = random * 6364136223846793005u + 1) >> 20;\n");
  const Outcome outcome = program(
      "run --size 32x16 --timing-frames 1 --no-verdict -s matching.parallelism=4 -s matching.iterations=1 "
      "--circuit matching=c.so");
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_NE(outcome.out.find(": parallax vectors --stage matching --taps writes each path's costs, and "
                             "parallax compare says which path differs\n"),
            std::string::npos)
      << outcome.out;
}

struct Waiting {
  const char* name;
  const char* valid;
  const char* handshake;  // up to the cycle
};

void PrintTo(const Waiting& waiting, std::ostream* out) { *out << waiting.name; }

class CircuitValid : public ::testing::TestWithParam<Waiting> {};

// What is not taken in the cycle in which it comes waits in a register.
TEST_P(CircuitValid, OfAnAxiStreamWaitsForNothing) {
  const Program program;
  make_cpp_circuit(program, "c",
                   "IN(clk, 1) IN(in_valid, 1) IN(in_data, 12) OUT(in_ready, 1) OUT(m_axis_tvalid, 1) "
                   "OUT(m_axis_tdata, 12) IN(m_axis_tready, 1)",
                   std::string("static bool full = false, was_ready = false;\n"
                               "if (rises && m_axis_tvalid && m_axis_tready) full = false;\n"
                               "if (rises && in_valid && in_ready) full = true, m_axis_tdata = in_data;\n"
                               "in_ready = !full;\n") +
                       GetParam().valid);
  for (const char* const stall : {"", "--circuit-stall 300"}) {
    const Outcome outcome = program(std::string(kMachine) + "--json " + kPlace + stall);
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    const nlohmann::json circuit = nlohmann::json::parse(outcome.out).at("circuits").at(0);
    const std::string told = circuit.value("handshake", "");
    EXPECT_EQ(told.substr(0, told.find(", in cycle ")), *stall == '\0' ? "" : GetParam().handshake);
    EXPECT_EQ(circuit.at("streams").at(0).at("got_tokens"), 512);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, CircuitValid,
    ::testing::Values(Waiting{"Not", "m_axis_tvalid = full;", ""},
                      Waiting{"Does", "m_axis_tvalid = full && m_axis_tready;",
                              "smoothed: m_axis_tvalid waits for m_axis_tready, and is 0 or 1 as it is"},
                      // By a register, it is not noticed.
                      Waiting{"Late",
                              "if (rises) was_ready = m_axis_tready;\n static bool begun;\n"
                              "if (!full) begun = false;\n if (full && was_ready) begun = true;\n"
                              "m_axis_tvalid = begun;",
                              ""}),
    [](const auto& each) { return std::string(each.param.name); });

}  // namespace circuit_messages_test
}  // namespace parallax::test
