// SPDX-License-Identifier: Apache-2.0
// parallax stage, and the library with which test benches ask it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "modules/census.hpp"
#include "platform/cosim/stage/parallax_stage.h"
#include "tests/cli/program.hpp"
#include "tests/modules/naive_census.hpp"

namespace parallax {
namespace stage_test {

using nlohmann::json;
using test::lines;

test::Grid<Gray> small_image() {
  test::Grid<Gray> image(32, 16);
  for (int i = 0; i < 32 * 16; ++i) image.data[i] = static_cast<Gray>(i * i % 253);
  return image;
}
std::vector<CensusCode> small_codes() {
  const test::Grid<CensusCode> codes = test::naive_census(CensusConfig{}, small_image());
  return {codes.data.begin(), codes.data.end()};
}

class StageCommand : public ::testing::Test {
 protected:
  test::Outcome ask(const std::string& arguments, const std::string& input) const {
    program_.folder().write("asked", input);
    return program_("stage " + arguments, [] {
      const int file = ::open("asked", O_RDONLY);
      ::dup2(file, STDIN_FILENO);
    });
  }
  std::string refusal(const std::string& input) const {
    const test::Outcome outcome = ask("census --size 32x16", input);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_EQ(lines(outcome.err).size(), 1u) << outcome.err;
    return outcome.err;
  }
  // What a stage of that machine makes of the tokens that went into it there is what came out of it there.
  void compare(const std::string& stage, const std::string& machine) const {
    SCOPED_TRACE(stage + " " + machine);
    const std::string folder = "v_" + stage;
    const test::Outcome made =
        program_(fmt::format("vectors --stage {} {} --frames 2 --out {} --json", stage, machine, folder));
    ASSERT_EQ(made.code, 0) << made.err;
    std::string asked, expected;
    for (const json& stream : json::parse(made.out).at("streams")) {
      const std::vector<std::string> tokens =
          lines(program_.read(folder + "/" + stream.at("file").get<std::string>()));
      ASSERT_FALSE(tokens.empty());
      asked += stream.at("port").get<std::string>();
      std::string& text = stream.at("direction") == "in" ? asked : expected;
      std::string line;
      for (const std::string& token : tokens) line += " " + token;
      text += stream.at("direction") == "in" ? line : line.substr(1) + "\n";
      asked += "\n";
    }
    const test::Outcome outcome = ask(stage + " " + machine, asked);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const std::size_t described = outcome.out.find("\n\n");
    ASSERT_NE(described, std::string::npos) << outcome.out;
    EXPECT_TRUE(outcome.out.substr(described + 2) == expected);
  }

  test::Program program_;
};

TEST_F(StageCommand, MakesWhatTheDefinitionOfTheCensusSays) {
  std::string asked = "in_left";
  for (const Gray pixel : small_image().data) asked += fmt::format(" {:x}", pixel);
  std::string expected =
      "in in_left left_rectified 8 32 512\n"
      "in in_right right_rectified 8 32 512\n"
      "out out_left left_codes 24 32 512\n"
      "out out_right right_codes 24 32 512\n\n";
  for (const CensusCode code : small_codes())
    expected += fmt::format("{}{:06x}", expected.back() == '\n' ? "" : " ", code);
  // By the name of the port, and by that of the stream; of the right image there is nothing.
  EXPECT_EQ(ask("census --size 32x16", asked + "\n\nleft_codes\nout_right\nout_left\n").out,
            expected + "\n\n\n");
}

TEST_F(StageCommand, MakesOfEachStagesTokensWhatTheMachineDoes) {
  for (const char* const stage : {"unpack_left", "unpack_right", "unpack_map", "map_decoder", "rectification",
                                  "census", "matching", "subpixel", "uniqueness", "consistency", "texture",
                                  "speckle", "gap_interpolation", "noise_reduction", "output_packing"}) {
    compare(stage, "--size 64x48 -d 32");
  }
}

TEST_F(StageCommand, TakesEveryKindOfToken) {
  const std::string eight_paths = "--size 64x48 -d 32 -s matching.paths=w,nw,n,ne,e,sw,s,se";
  for (const char* const stage : {"matching", "pack_rows", "unpack_rows", "pack_frame", "unpack_frame"})
    compare(stage, eight_paths + " -s matching.path_storage=memory");
  for (const char* const stage : {"unpack_left", "rectification", "census", "subpixel", "output_packing"})
    compare(stage, "--size 64x48 -d 32 -s pipeline.pixels_per_token=2");
}

TEST_F(StageCommand, RefusesWhatItDoesNotUnderstand) {
  EXPECT_EQ(
      refusal("\nin_lefd 1\n"),
      "parallax: error: standard input, line 2: the stage has no port 'in_lefd'; the nearest is in_left\n");
  EXPECT_EQ(refusal("in_left 1ff\n"),
            "parallax: error: standard input, line 1: in_left: '1ff' has more than 8 bits\n");
  EXPECT_EQ(refusal("in_left 1x\n"),
            "parallax: error: standard input, line 1: in_left: '1x' has unknown bits\n");
  EXPECT_EQ(refusal("out_left 1\n"),
            "parallax: error: standard input, line 1: out_left is an output, which takes no token\n");
  EXPECT_EQ(
      ask("census --size 31x9", "").err,
      "parallax: error: images of 31x9 are processed as 32x16, and so are their tokens: --size 32x16\n");
  EXPECT_EQ(ask("sensus", "").err,
            "parallax: error: parallax stage: there is no stage 'sensus'; the nearest of this machine's is "
            "census\n");
}

// Handles live as long as a test; the program is that of the tests.
class StageLibrary : public ::testing::Test {
 protected:
  StageLibrary() { ::setenv("PARALLAX", test::program_path().c_str(), 1); }
  ~StageLibrary() override { parallax_stage_close(stage_); }

  void open(const char* stage, const char* options) { stage_ = parallax_stage_open(stage, options); }
  std::string message() const { return parallax_stage_message(stage_); }
  // Whole images of a census of 32 x 16 pixels.
  void push_image() {
    for (const std::uint32_t pixel : small_image().data) {
      ASSERT_EQ(parallax_stage_push(stage_, "in_left", &pixel), 1);
    }
  }
  int check(std::uint64_t code, std::uint32_t unknown = 0) {
    const parallax_logic token{static_cast<std::uint32_t>(code), unknown};
    return parallax_stage_check(stage_, "out_left", &token);
  }

  void* stage_ = nullptr;
};

TEST_F(StageLibrary, HandsOverTheModelsTokens) {
  open("census", " --size  32x16 ");
  ASSERT_EQ(message(), "");
  EXPECT_EQ(parallax_stage_width(stage_, "in_left"), 8);
  EXPECT_EQ(parallax_stage_width(stage_, "left_codes"), 24);
  std::uint32_t code = 0;
  EXPECT_EQ(parallax_stage_pop(stage_, "out_left", &code), 0);
  push_image();
  for (const CensusCode expected : small_codes()) {
    ASSERT_EQ(parallax_stage_pop(stage_, "out_left", &code), 1);
    ASSERT_EQ(code, expected);
  }
  EXPECT_EQ(parallax_stage_pop(stage_, "out_left", &code), 0);
  EXPECT_EQ(message(), "");
}

// A token of 1024 bits, in words of 32.
TEST_F(StageLibrary, TakesTokensOfManyWords) {
  open("unpack_left", "--size 64x48");
  std::uint32_t burst[32];
  for (std::uint32_t i = 0; i < 32; ++i) burst[i] = 0x03020100u + i * 0x04040404u;
  ASSERT_EQ(parallax_stage_push(stage_, "in_bursts", burst), 1);
  std::uint32_t pixel = 0;
  for (std::uint32_t i = 0; i < 128; ++i) {
    ASSERT_EQ(parallax_stage_pop(stage_, "out_tokens", &pixel), 1);
    ASSERT_EQ(pixel, i);
  }
}

// Before the model, behind it, and both in turn.
TEST_F(StageLibrary, ChecksACircuitsTokens) {
  open("census", "--size 32x16");
  for (const CensusCode code : small_codes()) ASSERT_EQ(check(code), 1);
  push_image();
  EXPECT_EQ(parallax_stage_finish(stage_), 1) << message();
  push_image();
  for (const CensusCode code : small_codes()) ASSERT_EQ(check(code), 1);
  EXPECT_EQ(parallax_stage_finish(stage_), 1) << message();
}

TEST_F(StageLibrary, NamesTheFirstDifference) {
  open("census", "--size 32x16");
  push_image();
  const std::vector<CensusCode> right = small_codes();
  for (std::size_t i = 0; i < 69; ++i) ASSERT_EQ(check(right[i]), 1);
  EXPECT_EQ(check(right[69] ^ 0x10), 0);
  const std::string expected = fmt::format(
      "out_left: the first difference is token 69 (pass 0, row 2, token 5 of the row): expected "
      "{:06x}, got {:06x}",
      right[69], right[69] ^ 0x10);
  EXPECT_EQ(message(), expected);
  EXPECT_EQ(check(right[70]), 0);
  EXPECT_EQ(parallax_stage_finish(stage_), 0);
  EXPECT_EQ(message(), expected);
}

TEST_F(StageLibrary, TakesUnknownBitsForADifference) {
  open("census", "--size 32x16");
  push_image();
  const CensusCode code = small_codes()[0];
  EXPECT_EQ(check(code, 0xFF000000u), 1) << "above the port's width";
  EXPECT_EQ(check(small_codes()[1], 0x20), 0);
  const std::string digits = fmt::format("{:06x}", small_codes()[1]);
  EXPECT_EQ(message(), fmt::format("out_left: the first difference is token 1 (pass 0, row 0, token 1 of the "
                                   "row): expected {}, got {}x{}",
                                   digits, digits.substr(0, 4), digits.substr(5)));
}

TEST_F(StageLibrary, CountsTokensInTheEnd) {
  open("census", "--size 32x16");
  push_image();
  for (std::size_t i = 0; i < 40; ++i) ASSERT_EQ(check(small_codes()[i]), 1);
  EXPECT_EQ(parallax_stage_finish(stage_), 0);
  EXPECT_EQ(message(), "out_left: the circuit has given 40 tokens, the model 472 more");
}

TEST_F(StageLibrary, CountsTokensThatAreTooMany) {
  open("census", "--size 32x16");
  push_image();
  for (const CensusCode code : small_codes()) ASSERT_EQ(check(code), 1);
  EXPECT_EQ(check(0), 1) << "the next image may bring it";
  EXPECT_EQ(parallax_stage_finish(stage_), 0);
  EXPECT_EQ(message(), "out_left: the circuit has given 1 token more than the model, which has made 512");
}

TEST_F(StageLibrary, SaysWhyItCannot) {
  const auto after = [this](auto action) {
    parallax_stage_close(stage_);
    open("census", "--size 32x16");
    EXPECT_EQ(message(), "");
    EXPECT_EQ(action(), 0);
    return message();
  };
  const std::uint32_t wide = 0x100;
  std::uint32_t token = 0;
  const parallax_logic logic{0, 0};
  EXPECT_EQ(after([&] { return parallax_stage_push(stage_, "in_lefd", &token); }),
            "the stage has no port in_lefd: it has in_left, in_right, out_left, out_right");
  EXPECT_EQ(after([&] { return parallax_stage_push(stage_, "in_left", &wide); }),
            "in_left takes tokens of 8 bits");
  EXPECT_EQ(after([&] { return parallax_stage_push(stage_, "out_left", &token); }),
            "out_left is an output, which takes no token");
  EXPECT_EQ(after([&] { return parallax_stage_pop(stage_, "in_left", &token); }),
            "in_left is an input, which gives no token");
  EXPECT_EQ(after([&] { return parallax_stage_check(stage_, "in_left", &logic); }),
            "in_left is an input, which gives no token");
  EXPECT_EQ(after([&] { return parallax_stage_width(stage_, "left"); }),
            "the stage has no port left: it has in_left, in_right, out_left, out_right");
  EXPECT_STREQ(parallax_stage_message(nullptr), "there is no handle");
  EXPECT_EQ(parallax_stage_push(nullptr, "in_left", &token), 0);
  EXPECT_EQ(parallax_stage_finish(nullptr), 0);
}

TEST_F(StageLibrary, SaysWhyThereIsNoModel) {
  open("census", "-s census.window_width=4");
  EXPECT_EQ(message().rfind("census.window_width", 0), 0u) << message();
  parallax_stage_close(stage_);
  open("matching",
       "--size 64x48 -s matching.parallelism=256 -s matching.iterations=1 "
       "-s matching.path_bits=16 -s matching.path_storage=memory");
  EXPECT_EQ(message(), "in_rows has tokens of 12336 bits; 8192 is the most here");
  parallax_stage_close(stage_);
  ::setenv("PARALLAX", "/nowhere/parallax", 1);
  open("census", "");
  EXPECT_EQ(message(),
            "the program /nowhere/parallax cannot be started (No such file or directory); PARALLAX in the "
            "environment says where it is, else PATH");
  parallax_stage_close(stage_);
  ::setenv("PARALLAX", "true", 1);
  open("census", "");
  EXPECT_EQ(message(), "the program parallax has ended");
}

}  // namespace stage_test
}  // namespace parallax
