// SPDX-License-Identifier: Apache-2.0
// Whether start of frame and end of line beside a circuit's outputs are in their places.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

#include "tests/cosim/make_cpp_circuit.hpp"

namespace parallax::test {
namespace circuit_framing_test {

// Passes its tokens on; `at` counts those of a frame of 32x16.
constexpr const char* kThrough = R"(
  static unsigned at = 0;
  if (rises && s_axis_tvalid && m_axis_tready) at = (at + 1) % 512;
  s_axis_tready = m_axis_tready, m_axis_tvalid = s_axis_tvalid, m_axis_tdata = s_axis_tdata;
)";
constexpr const char* kPins =
    "IN(clk, 1) IN(s_axis_tdata, 16) IN(s_axis_tvalid, 1) OUT(s_axis_tready, 1) OUT(m_axis_tdata, 16) "
    "OUT(m_axis_tvalid, 1) IN(m_axis_tready, 1) ";
constexpr const char* kMarks = "OUT(m_axis_tlast, 1) OUT(m_axis_tuser, 2) ";

std::string framing_of(const std::string& pins, const std::string& body, const std::string& options = "") {
  const Program program;
  make_cpp_circuit(program, "c", kPins + pins, kThrough + body);
  const Outcome outcome = program(
      "run --size 32x16 --no-verdict --timing-frames 2 --json --circuit noise_reduction=c.so " + options);
  EXPECT_EQ(outcome.code, 1) << "it reduces no noise: " << outcome.err;
  const nlohmann::json circuit = nlohmann::json::parse(outcome.out).at("circuits").at(0);
  EXPECT_EQ(circuit.at("streams").at(0).at("got_tokens"), 512);
  return circuit.value("framing", "");
}

struct Framing {
  const char* name;
  const char* body;
  const char* message;  // up to the cycle
};

void PrintTo(const Framing& framing, std::ostream* out) { *out << framing.name; }

class CircuitFraming : public ::testing::TestWithParam<Framing> {};

TEST_P(CircuitFraming, IsCheckedAgainstTheTokensPlace) {
  for (const char* const options : {"", "--circuit-stall 300"}) {
    const std::string told = framing_of(kMarks, GetParam().body, options);
    EXPECT_EQ(told.substr(0, told.find(", in cycle ")) + told.substr(std::min(told.find(';'), told.size())),
              GetParam().message);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, CircuitFraming,
    ::testing::Values(
        Framing{"EachRow", "m_axis_tlast = at % 32 == 31, m_axis_tuser = at == 0;", ""},
        Framing{"EachFrame", "m_axis_tlast = at == 511, m_axis_tuser = at == 0;", ""},
        // Bits above the lowest one are the user's.
        Framing{"WideUser", "m_axis_tlast = at == 511, m_axis_tuser = at == 0 ? 3 : 2;", ""},
        Framing{
            "NoLast", "m_axis_tlast = 0, m_axis_tuser = at == 0;",
            "smoothed: m_axis_tlast is 0 with token 511 of frame 0 (row 15, column 31); it is to be 1 with "
            "the last token of each frame alone"},
        Framing{
            "LateLast", "m_axis_tlast = at % 32 == 31 && at != 95, m_axis_tuser = at == 0;",
            "smoothed: m_axis_tlast is 0 with token 95 of frame 0 (row 2, column 31); it is to be 1 with the "
            "last token of each row alone"},
        Framing{
            "EarlyLast", "m_axis_tlast = at % 32 == 30, m_axis_tuser = at == 0;",
            "smoothed: m_axis_tlast is 1 with token 30 of frame 0 (row 0, column 30); it is to be 1 with the "
            "last token of each row, or frame alone"},
        Framing{
            "LastOfSomeRows", "m_axis_tlast = at % 64 == 63, m_axis_tuser = at == 0;",
            "smoothed: m_axis_tlast is 1 with token 63 of frame 0 (row 1, column 31); it is to be 1 with the "
            "last token of each frame alone"},
        Framing{
            "NoFirst", "m_axis_tlast = at % 32 == 31, m_axis_tuser = 2;",
            "smoothed: m_axis_tuser[0] is 0 with token 0 of frame 0 (row 0, column 0); it is to be 1 with "
            "the first token of each frame alone"},
        Framing{
            "FirstOfRows", "m_axis_tlast = at % 32 == 31, m_axis_tuser = at % 32 == 0;",
            "smoothed: m_axis_tuser[0] is 1 with token 32 of frame 0 (row 1, column 0); it is to be 1 with "
            "the first token of each frame alone"},
        // The counter that a second frame does not clear.
        Framing{
            "FirstOnce",
            "static bool begun = false;\n begun |= at == 9;\n m_axis_tlast = at % 32 == 31;\n"
            "m_axis_tuser = at == 0 && !begun;",
            "smoothed: m_axis_tuser[0] is 0 with token 0 of frame 1 (row 0, column 0); it is to be 1 with "
            "the first token of each frame alone"}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(CircuitFramingPins, AreLeftWhereTheUserSaysSo) {
  const std::string wrong = "m_axis_tlast = 1, m_axis_tuser = 1;";
  EXPECT_NE(framing_of(kMarks, wrong, "--circuit-pins out_disparity.last="), "");
  EXPECT_EQ(
      framing_of(kMarks, wrong, "--circuit-pins out_disparity.last= --circuit-pins out_disparity.first="),
      "");
}

TEST(CircuitFramingPins, MayBeNamed) {
  const std::string told = framing_of("OUT(marks, 5) ", "marks = at % 32 == 31 ? 0 : 16;",
                                      "--circuit-pins out_disparity.last=marks[4]");
  EXPECT_EQ(told.find("smoothed: marks[4] is 1 with token 0 of frame 0 (row 0, column 0), in cycle "), 0U)
      << told;
}

// Nothing needs them: an input or a number of such a name is something else.
TEST(CircuitFramingPins, AreOneBitOut) {
  EXPECT_EQ(framing_of("OUT(m_axis_tlast, 3) ", "m_axis_tlast = 5;"), "");
  EXPECT_EQ(framing_of("IN(m_axis_last, 1) ", "", "--circuit-set m_axis_last=1"), "");
}

TEST(CircuitFramingPins, StayWhileTheirTokenWaits) {
  const Program program;
  make_cpp_circuit(
      program, "c", std::string(kPins) + kMarks,
      std::string(kThrough) + "m_axis_tlast = at % 32 == 31 && m_axis_tready, m_axis_tuser = at == 0;");
  const Outcome outcome = program(
      "run --size 32x16 --no-verdict --timing-frames 1 --circuit-stall 500 --circuit noise_reduction=c.so");
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_NE(outcome.out.find("handshake           smoothed: m_axis_tlast changes before token "),
            std::string::npos)
      << outcome.out;
}

// Of a census with one valid for both images, one of each for both.
TEST(CircuitFramingPins, AreSharedWhereTokensPassTogether) {
  const Program program;
  make_cpp_circuit(
      program, "c",
      "IN(clk, 1) IN(in_left, 8) IN(in_right, 8) IN(valid_in, 1) OUT(out_left, 2) OUT(out_right, 2) "
      "OUT(valid_out, 1) OUT(eol, 1)",
      "static unsigned at = 0;\n if (rises && valid_in) ++at;\n valid_out = valid_in, eol = at == 7;");
  const Outcome outcome = program(
      "run --size 32x16 --timing-frames 1 --no-verdict -s census.window_width=3 -s census.window_height=1 "
      "--circuit census=c.so");
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_NE(outcome.out.find(
                "framing             left_codes: eol is 1 with token 7 of frame 0 (row 0, column 7), in "
                "cycle "),
            std::string::npos)
      << outcome.out;
}

}  // namespace circuit_framing_test
}  // namespace parallax::test
