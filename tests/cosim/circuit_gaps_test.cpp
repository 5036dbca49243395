// SPDX-License-Identifier: Apache-2.0
// Circuits that need blanking behind rows and frames, and line_valid and frame_valid beside their tokens.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/cli/program.hpp"
#include "tests/cosim/make_cpp_circuit.hpp"

namespace parallax::test {
namespace circuit_gaps_test {

constexpr const char* kCensus =
    "run --size 32x16 --frames 2 --timing-frames 2 --no-verdict -s census.window_width=3 -s "
    "census.window_height=1 "
    "--circuit census=circuit.so ";

// A census of 3x1 pixels of two images. Code i leaves when pixel i + 1 is taken, that of a row's last pixel
// at the first edge of the gap behind it. Codes are wrong where a row or frame is not what its pins say: rows
// of 32 pixels, frames of 16 rows, and between them gaps of at least ROW_GAP and FRAME_GAP edges.
std::string row_census(const std::string& taken, const std::string& in_row, const std::string& in_frame,
                       int row_gap, int frame_gap) {
  return fmt::format(R"(
  if (!rises) return;
  static unsigned past[2], here[2], pixels = 0, rows = 0, low = 1000000, frame_low = 1000000;
  static bool wrong = false;
  const bool taken = {}, in_row = {}, in_frame = {};
  const unsigned next[2] = {{unsigned(in_left), unsigned(in_right)}};
  const bool first = pixels == 0;
  if (taken && first && low < {}) wrong = true;
  if (taken && first && rows == 0 && frame_low < {}) wrong = true;
  if (!in_row && pixels % 32 != 0) wrong = true;
  if (!in_frame && rows % 16 != 0 && !(rows == 15 && pixels == 32)) wrong = true;
  low = in_row ? 0 : low + 1;
  frame_low = in_frame ? 0 : frame_low + 1;
  const bool ends = pixels == 32 && !taken;
  const bool emits = ends || (taken && !first);
  std::uint64_t* const codes[2] = {{&out_left, &out_right}};
  for (int i = 0; i < 2 && emits; ++i)
    *codes[i] = wrong ? 3 : (pixels > 1 && past[i] < here[i]) << 1 | (!ends && next[i] < here[i]);
  OUT_VALID = emits;
  if (pixels == 32 && taken) wrong = true;
  if (ends) pixels = 0, rows = (rows + 1) % 16;
  if (!taken) return;
  ++pixels;
  for (int i = 0; i < 2; ++i) past[i] = here[i], here[i] = next[i];
)",
                     taken, in_row, in_frame, row_gap, frame_gap);
}

constexpr const char* kPins = "IN(clk, 1) IN(in_left, 8) IN(in_right, 8) OUT(out_left, 2) OUT(out_right, 2) ";
constexpr const char* kHasValid = "OUT(out_valid, 1)\n#define OUT_VALID out_valid\n";
constexpr const char* kHasNone = "\nstatic bool nothing;\n#define OUT_VALID nothing\n";

class CircuitGaps : public ::testing::Test {
 protected:
  Outcome run(const std::string& options) const { return program(kCensus + options); }
  void expect_equal(const std::string& options) const {
    const Outcome outcome = run(options);
    EXPECT_EQ(outcome.code, 0) << options << '\n' << outcome.err << outcome.out;
    EXPECT_NE(outcome.out.find("left_codes: equal, 1024 tokens"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("right_codes: equal, 1024 tokens"), std::string::npos) << outcome.out;
  }
  void expect_refused(const std::string& options, const std::string& message) const {
    const Outcome outcome = run(options);
    EXPECT_EQ(outcome.code, 2) << outcome.out;
    EXPECT_EQ(outcome.err, "parallax: error: " + message + "\n");
  }

  const Program program;
};

// Rows come slower than such gaps allow, so that these are all that lies between them.
TEST_F(CircuitGaps, LieBehindRows) {
  make_cpp_circuit(program, "circuit", std::string(kPins) + "IN(in_valid, 1) " + kHasValid,
                   row_census("in_valid", "in_valid || pixels % 32 != 0", "true", 200, 0));
  expect_equal("--circuit-row-gap 200");
  expect_equal("--circuit-row-gap 200 --circuit-stall 300");
  expect_equal("--circuit-row-gap 200 --circuit-interval 3 -s streams.left_codes.depth=1");
  EXPECT_EQ(run("--circuit-row-gap 199").code, 1);
}

// line_valid stays 1 between the pixels of a row, frame_valid between the rows of a frame.
TEST_F(CircuitGaps, AreShownByLineAndFrameValid) {
  make_cpp_circuit(program, "circuit", std::string(kPins) + "IN(de, 1) IN(lval, 1) IN(fval, 1) " + kHasValid,
                   row_census("de", "lval", "fval", 200, 900));
  const std::string gaps = "--circuit-row-gap 200 --circuit-frame-gap 900 ";
  expect_equal(gaps);
  expect_equal(gaps + "--circuit-stall 400");
  expect_equal(gaps + "--circuit-interval 2 --circuit-stall 200");
  EXPECT_EQ(run("--circuit-row-gap 199 --circuit-frame-gap 900").code, 1);
}

// As from a camera: without valid the clock stands where a row has no pixel, and runs between rows.
TEST_F(CircuitGaps, ALineValidAloneIsTheHandshake) {
  make_cpp_circuit(program, "circuit", std::string(kPins) + "IN(href, 1) IN(vsync, 1) " + kHasValid,
                   row_census("href", "href", "vsync", 200, 900));
  const std::string frames =
      "--circuit-pins in_left.frame_valid=vsync --circuit-pins in_right.frame_valid=vsync "
      "--circuit-frame-gap 900 ";
  expect_equal(frames + "--circuit-row-gap 200");
  expect_equal(frames + "--circuit-row-gap 200 --circuit-stall 400");
  EXPECT_EQ(run(frames + "--circuit-row-gap 199").code, 1);
}

// Results are counted from the edges that took a token: that of a row's end leaves in the gap. The clock
// stands where there is no token, so that the gaps are what the circuit sees.
TEST_F(CircuitGaps, HoldWithALatencyWithoutValid) {
  make_cpp_circuit(program, "circuit", std::string(kPins) + "IN(in_valid, 1)" + kHasNone,
                   row_census("in_valid", "in_valid || pixels % 32 != 0",
                              "in_valid || pixels % 32 != 0 || rows % 16 != 0", 3, 2000));
  const std::string latency = "--circuit-latency 2 --circuit-flush 0 ";
  // The circuit knows of a frame's end an edge after it.
  expect_equal(latency + "--circuit-row-gap 3 --circuit-frame-gap 2001");
  expect_equal(latency + "--circuit-row-gap 3 --circuit-frame-gap 2001 --circuit-stall 300");
  EXPECT_EQ(run(latency + "--circuit-row-gap 3 --circuit-frame-gap 2000").code, 1);
  EXPECT_EQ(run(latency + "--circuit-row-gap 2 --circuit-frame-gap 2001").code, 1);
}

// Zeros behind a frame are rows of it: 32 of them, and 8.
TEST_F(CircuitGaps, AreBetweenTheZerosOfAFrame) {
  make_cpp_circuit(program, "circuit",
                   std::string(kPins) + "IN(in_valid, 1) IN(lval, 1) IN(fval, 1) " + kHasValid, R"(
  static unsigned taken = 0, rows = 0;
  static bool in_row = false, wrong = false;
  if (!rises) return;
  out_valid = in_valid && taken < 512;
  if (in_row && !lval) ++rows;
  if (in_valid && taken == 0 && rows % 18 != 0) wrong = true;
  if (!fval && taken % 552 != 0) wrong = true;
  in_row = lval;
  if (in_valid) taken = (taken + 1) % 552;
  out_left = out_right = wrong ? 1 : 0;
)");
  // How many codes are not 0, or not 1, is the images' matter; that wrong ones are others is the circuit's.
  const auto differing = [&](const std::string& options) {
    const Outcome outcome = run("--circuit-flush 40 " + options);
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    const std::size_t at = outcome.out.find("left_codes: ");
    return outcome.out.substr(at, outcome.out.find('\n', at) - at);
  };
  const std::string right = differing("--circuit-row-gap 2");
  EXPECT_NE(right.find(" of 1024 tokens differ"), std::string::npos) << right;
  EXPECT_EQ(differing("--circuit-row-gap 2 --circuit-stall 300"), right);
  EXPECT_EQ(differing("--circuit-row-gap 9 --circuit-frame-gap 40 --circuit-interval 3"), right);
  EXPECT_NE(differing(""), right) << "the zeros follow the last row at once";
}

TEST_F(CircuitGaps, AreRefusedWhereNothingShowsThem) {
  make_cpp_circuit(program, "circuit", std::string(kPins) + "IN(in_left_fval, 1)", "");
  expect_refused("--circuit-row-gap 4",
                 "--circuit-row-gap 4: circuit circuit has neither valid nor line_valid at in_left, which "
                 "would tell it of a gap; --circuit-pins in_left.line_valid=PIN names one");
  expect_refused("--circuit-frame-gap 4",
                 "--circuit-frame-gap 4: circuit circuit has neither valid, line_valid nor frame_valid at "
                 "in_right, which would tell it of a gap; --circuit-pins in_right.frame_valid=PIN names one");
  make_cpp_circuit(program, "circuit",
                   "IN(clk, 1) IN(in_data, 1024) IN(in_valid, 1) OUT(out_data, 8) OUT(out_valid, 1)", "");
  const Outcome outcome =
      program("run --size 32x16 --no-verdict --circuit unpack_left=circuit.so --circuit-row-gap 1");
  EXPECT_EQ(outcome.err,
            "parallax: error: --circuit-row-gap 1: the inputs of unpack_left know no rows; leave it out\n");
}

}  // namespace circuit_gaps_test
}  // namespace parallax::test
