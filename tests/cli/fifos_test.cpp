// SPDX-License-Identifier: Apache-2.0
// `parallax fifos`: what it finds holds when run again.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/cli/program.hpp"

namespace parallax::test {
namespace fifos_test {

using Json = nlohmann::json;

constexpr const char* kMachine = " --size 64x48 -d 64 --set link.host_pixel_rate=0 ";

class Fifos : public testing::Test {
 protected:
  Json find(const std::string& arguments, int code = 0) const {
    const Outcome outcome = program_("fifos --json" + std::string(kMachine) + arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    return Json::parse(outcome.out, nullptr, false);
  }
  // The one line of an error.
  std::string error(const std::string& arguments, int code = 2) const {
    const Outcome outcome = program_("fifos " + arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(lines(outcome.err).size(), 1U) << outcome.err;
    return outcome.err;
  }

  Program program_;
};

// By `run`, which knows nothing of the search.
TEST_F(Fifos, ThePresetKeepsTheFullRateAndOneTokenLessInAnyFifoDoesNot_large) {
  const Json tree = find("--out found");
  const double full = tree["deep"]["frame_rate"]["value"];
  const auto rate = [&](const std::string& arguments) {
    const Outcome outcome = program_(fmt::format(
        "run --timing-only --no-verdict --json --size 64x48 --timing-frames {} --preset found/depths.toml {}",
        tree["frames"].get<int>(), arguments));
    if (outcome.code == 1) return 0.0;  // stuck
    return Json::parse(outcome.out)["performance"]["frame_rate"]["value"].get<double>();
  };
  EXPECT_GE(rate(""), full * (1 - 1e-5));
  int less = 0;
  for (const Json& fifo : tree["fifos"]) {
    const std::int64_t depth = fifo["smallest_depth"];
    EXPECT_LE(depth, fifo["depth_now"]);
    EXPECT_EQ(fifo["smallest_bits"], depth * fifo["width"].get<std::int64_t>());
    if (depth == 1) continue;
    const std::string stream = fifo["stream"];
    EXPECT_LT(rate(fmt::format("--set streams.{}.depth={}", stream, depth - 1)), full * (1 - 1e-5)) << stream;
    EXPECT_EQ(tree["proof"][less]["stream"], stream);
    EXPECT_EQ(tree["proof"][less]["depth"], depth - 1);
    ++less;
  }
  EXPECT_EQ(tree["proof"].size(), static_cast<std::size_t>(less));
  EXPECT_GT(less, 3);
  EXPECT_EQ(program_.files("found"), (std::vector<std::string>{"depths.toml", "fifos.json"}));
  EXPECT_EQ(Json::parse(program_.read("found/fifos.json"))["fifos"], tree["fifos"]);
}

TEST_F(Fifos, GoalsAskForFewerBitsTheLessTheyWant) {
  const auto bits = [](const Json& tree) { return tree["smallest"]["storage"]["value"].get<double>(); };
  const Json full = find(""), half = find("--rate 700"), any = find("--goal deadlock-free");
  EXPECT_LE(bits(half), bits(full));
  EXPECT_LE(bits(any), bits(half));
  EXPECT_LT(bits(any), bits(full));
  EXPECT_GE(half["smallest"]["frame_rate"]["value"], 700);
  EXPECT_EQ(any["goal"]["kind"], "deadlock-free");
  for (const Json& run : any["proof"]) EXPECT_EQ(run["status"], "stuck");
}

TEST_F(Fifos, TheTableSaysWhatTheProofWas) {
  const Outcome outcome = program_("fifos" + std::string(kMachine) + "--front");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.rfind("goal                full rate: ", 0), 0U) << outcome.out;
  for (const char* part :
       {"\nlimit  ", "\nleft_output ", "\nall ", "\nproof               run with one token less in each of ",
        " too slow, ", "\nruns ", "\nfront "})
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part << outcome.out;
}

TEST_F(Fifos, ARateThatIsNotThereIsOneLineWithWhatIs) {
  const std::string line = error("--size 64x48 -d 64 --rate 1e9", 1);
  EXPECT_EQ(
      line.rfind("parallax: error: --rate 1000000000 is not reached: with deep FIFOs the machine has ", 0),
      0U)
      << line;
}

TEST_F(Fifos, BadOptionsAreOneLine) {
  EXPECT_EQ(error("--goal fast"),
            "parallax: error: --goal is 'fast', allowed is full-rate or deadlock-free\n");
  EXPECT_EQ(error("--rate 0"), "parallax: error: --rate is 0, it must be more than 0 frames/s\n");
  EXPECT_EQ(error("--rate 10 --goal deadlock-free"),
            "parallax: error: --rate and --goal deadlock-free exclude each other: each is a goal\n");
  EXPECT_EQ(error("--rate 10 --tolerance 1"),
            "parallax: error: --tolerance is of the full rate, but the goal is another\n");
  EXPECT_EQ(error("--tolerance -1"), "parallax: error: --tolerance is -1, allowed is 0 to 100 %\n");
  EXPECT_EQ(error("--size 64x48 --timing-frames 3"),
            "parallax: error: --timing-frames is 3, but three frames of the steady state take 11\n");
}

TEST_F(Fifos, ItsOwnPresetIsNotReplaced) {
  program_.folder().write("depths.toml", "inherits = \"scenescan-pro\"\n");
  const std::string line = error("--size 64x48 --preset depths.toml --out .");
  EXPECT_NE(line.find("depths.toml"), std::string::npos) << line;
}

TEST_F(Fifos, CtrlCEndsIt) {
  const pid_t child = program_.start("fifos --size 640x480 --out out");
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  ::kill(child, SIGINT);
  const Outcome outcome = program_.wait(child);
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err.rfind("parallax: interrupted after ", 0), 0U) << outcome.err;
  EXPECT_EQ(program_.files(), std::vector<std::string>{});
}

}  // namespace fifos_test
}  // namespace parallax::test
