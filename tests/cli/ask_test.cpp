// SPDX-License-Identifier: Apache-2.0
// One question to a machine, and the runs that answer it.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"

namespace parallax {
namespace ask_test {

const std::string kMachine = " --preset core-alone --rectified --size 64x48 --timing-frames 2";

TEST(Ask, ShowsThatTheNextValueDoesNotHold) {
  const test::Program program;
  const test::Outcome outcome =
      program("ask least clocks.core_hz --hold performance/frame_rate>=10000 --json" + kMachine);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json tree = nlohmann::json::parse(outcome.out);
  const std::string answer = tree["answer"];
  const auto rate = [&](double clock) {
    const test::Outcome run = program("run --timing-only -q --json --set clocks.core_hz=" +
                                      std::to_string(static_cast<long long>(clock)) + kMachine);
    return nlohmann::json::parse(run.out)["performance"]["frame_rate"]["value"].get<double>();
  };
  EXPECT_GE(rate(std::stod(answer)), 10000);
  EXPECT_LT(rate(std::stod(answer) - 1e6), 10000) << "three digits";
  // The command of a run makes it again.
  for (const nlohmann::json& run : tree["runs"]) {
    if (run["value"] != answer) continue;
    const std::string command = run["command"];
    const nlohmann::json again =
        nlohmann::json::parse(program(command.substr(command.find(" ") + 1) + " --json -q").out);
    EXPECT_EQ(again["performance"]["frame_rate"]["value"], run["performance/frame_rate"]);
  }
}

// The larger the time, the slower; the largest one is looked for.
TEST(Ask, FindsTheLargestToo) {
  const test::Program program;
  const test::Outcome outcome = program(
      "ask most software.response_ns --hold performance/frame_rate>=5000 --from 100 --to 1e6" + kMachine);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.rfind("answer              software.response_ns = ", 0), 0U) << outcome.out;
}

TEST(Ask, SaysThatNoneHolds) {
  const test::Program program;
  const test::Outcome outcome =
      program("ask least matching.parallelism --hold performance/frame_rate>=1e9 -d 64" + kMachine);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.out.rfind(
                "answer              none from 4 to 64 has performance/frame_rate at least 1000000000 "
                "fps; with 64: ",
                0),
            0U)
      << outcome.out;
}

// 24 lanes for 64 disparities are no machine, and are not asked.
TEST(Ask, LeavesOutWhatIsNoMachine) {
  const test::Program program;
  const test::Outcome outcome =
      program("ask least matching.parallelism --hold performance/frame_rate>=1 -d 64 --json" + kMachine);
  const nlohmann::json tree = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(tree["answer"], "4") << outcome.out;
  for (const nlohmann::json& run : tree["runs"]) EXPECT_EQ(run["status"], "done");
}

// Both bounds hold with the answer; with the value before it one of them does not.
TEST(Ask, HoldsSeveralBounds) {
  const test::Program program;
  const std::string question =
      "ask least clocks.core_hz --hold performance/frame_rate>=10000 --json" + kMachine;
  const std::string both = question + " --hold latency/exposure_to_host_mean<=";
  const auto tree = [&](const std::string& words) { return nlohmann::json::parse(program(words).out); };
  const nlohmann::json alone = tree(question);
  const nlohmann::json loose = tree(both + "1000");
  EXPECT_EQ(loose["answer"], alone["answer"]) << "a bound that always holds changes nothing";
  // Half the latency that the slowest clock has: now this bound decides.
  const std::string slowest = alone["answer"];
  for (const nlohmann::json& run : loose["runs"]) {
    if (run["value"] != slowest) continue;
    const nlohmann::json tight =
        tree(both + std::to_string(run["latency/exposure_to_host_mean"].get<double>() * 0.9));
    EXPECT_GT(std::stod(tight["answer"].get<std::string>()), std::stod(slowest));
  }
}

// The machine as it is lies above what holds, and both ends of what is looked at fail: against each value
// by itself.
TEST(Ask, FindsWhatLiesBetweenTwoBounds) {
  const test::Program program;
  const std::string holds =
      " --hold performance/frame_rate>=8000 --hold performance/frame_rate<=9000 --json" + kMachine;
  std::vector<double> held;
  const nlohmann::json grid = nlohmann::json::parse(
      program("ask least clocks.core_hz --vary clocks.core_hz=40e6:160e6:2e6" + holds).out);
  for (const nlohmann::json& run : grid["runs"]) {
    if (run["holds"]) held.push_back(std::stod(run["values"]["clocks.core_hz"].get<std::string>()));
  }
  ASSERT_FALSE(held.empty());
  const auto [least, most] = std::minmax_element(held.begin(), held.end());
  const auto answer = [&](const std::string& which, const std::string& start) {
    const test::Outcome outcome = program("ask " + which + " clocks.core_hz --set clocks.core_hz=" + start +
                                          " --from 20e6 --to 400e6" + holds);
    EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
    return std::stod(nlohmann::json::parse(outcome.out)["answer"].get<std::string>());
  };
  // Three digits are finer than the grid.
  for (const char* start : {"20e6", "400e6"}) {
    const double first = answer("least", start);
    EXPECT_LE(first, *least) << start;
    EXPECT_GT(first, *least - 2e6) << start;
    const double last = answer("most", start);
    EXPECT_GE(last, *most) << start;
    EXPECT_LT(last, *most + 2e6) << start;
  }
}

// Of all combinations, each run by itself.
TEST(Ask, FindsTheBestOfAGrid) {
  const test::Program program;
  const test::Outcome outcome = program(
      "ask least resources/lut --vary clocks.core_hz=50e6,100e6,200e6 --vary matching.parallelism=4,8,16,24 "
      "--hold performance/frame_rate>=3000 -d 32 --json" +
      kMachine);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json tree = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(tree["runs"].size(), 12U);
  double least = 1e9;
  bool before_held = true;
  int impossible = 0;
  for (const nlohmann::json& run : tree["runs"]) {
    EXPECT_LE(run["holds"], before_held) << "those that hold come first";
    before_held = run["holds"];
    impossible += run["status"] == "invalid" ? 1 : 0;
    if (run["status"] != "done") continue;
    const std::string command = run["command"];
    const nlohmann::json alone =
        nlohmann::json::parse(program(command.substr(command.find(' ') + 1) + " --json -q").out);
    EXPECT_EQ(alone["performance"]["frame_rate"]["value"], run["performance/frame_rate"]);
    EXPECT_EQ(run["holds"], run["performance/frame_rate"] >= 3000);
    if (run["holds"]) least = std::min(least, run["resources/lut"].get<double>());
  }
  EXPECT_EQ(impossible, 3) << "24 lanes for 32 disparities";
  EXPECT_EQ(tree["runs"][0]["resources/lut"], least);
  EXPECT_EQ(tree["answer"], tree["runs"][0]["values"]);
  EXPECT_GT(least, 0);
}

// A key that varies is a number, too; here the largest.
TEST(Ask, FindsTheBestValueOfAKeyThatVaries) {
  const test::Program program;
  const test::Outcome outcome = program(
      "ask most clocks.core_hz --vary clocks.core_hz=50e6,200e6,100e6 --hold performance/frame_rate<=8000" +
      kMachine);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.rfind("answer              clocks.core_hz = ", 0), 0U) << outcome.out;
}

TEST(Ask, ShowsTheNearestWhereNoneOfAGridHolds) {
  const test::Program program;
  const test::Outcome outcome = program(
      "ask least energy/frame_total --vary clocks.core_hz=50e6,100e6 --hold performance/frame_rate>=1e9" +
      kMachine);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(
      outcome.out.rfind("answer              none has performance/frame_rate at least 1000000000 fps; the "
                        "nearest, clocks.core_hz = 100e6: ",
                        0),
      0U)
      << outcome.out;
}

TEST(Ask, ShowsWhatAChangeBrings) {
  const test::Program program;
  const std::string question =
      "ask effect clocks.core_hz=50e6 streams.default_depth=8 --device zynq-7045" + kMachine;
  const test::Outcome outcome = program(question + " --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json tree = nlohmann::json::parse(outcome.out);
  for (const char* side : {"without", "with"}) {
    const std::string command = tree[side]["command"];
    const nlohmann::json alone =
        nlohmann::json::parse(program(command.substr(command.find(' ') + 1) + " --json -q").out);
    EXPECT_EQ(alone["performance"]["frame_rate"], tree[side]["numbers"]["performance/frame_rate"]) << side;
    EXPECT_TRUE(tree[side]["numbers"].contains("devices/zynq_7045/fits"));
  }
  EXPECT_LT(tree["with"]["numbers"]["performance/frame_rate"]["value"],
            tree["without"]["numbers"]["performance/frame_rate"]["value"]);
  EXPECT_NE(program(question).out.find("performance/frame_rate"), std::string::npos);
}

// What gets stuck has no numbers, and is said.
TEST(Ask, ShowsThatAChangeStopsTheMachine) {
  const test::Program program;
  const test::Outcome outcome =
      program("ask effect streams.left_texture.depth=1 --size 64x48 --timing-frames 2 --rectified");
  EXPECT_EQ(outcome.code, 1) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("with                stuck: "), std::string::npos) << outcome.out;
}

struct Wrong {
  const char* arguments;
  const char* line;
};

void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.arguments; }

class WrongQuestion : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongQuestion, IsOneLine) {
  const test::Outcome outcome = test::Program()(std::string("ask ") + GetParam().arguments);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err, std::string("parallax: error: ") + GetParam().line + "\n");
}

INSTANTIATE_TEST_SUITE_P(
    Of, WrongQuestion,
    ::testing::Values(
        Wrong{"least clocks.core --hold performance/frame_rate>=60",
              "unknown key clocks.core; the nearest is clocks.core_hz"},
        Wrong{"least matching.cost --hold performance/frame_rate>=60",
              "matching.cost is no number: it is one of hamming, absolute_difference"},
        Wrong{"least clocks.core_hz --hold performance/frame_rate=60",
              "--hold performance/frame_rate=60: must have the form NUMBER>=VALUE or NUMBER<=VALUE, as "
              "performance/frame_rate>=60"},
        Wrong{"least clocks.core_hz --hold performance/frame_rate>=fast",
              "--hold performance/frame_rate>=fast: 'fast' is no number"},
        Wrong{
            "least clocks.core_hz --hold performance/framerate>=60",
            "--hold performance/framerate>=60: no number of a run or an estimate is called "
            "performance/framerate, and no key that varies; the nearest is performance/frame_rate (parallax "
            "glossary)"},
        Wrong{"least clocks.core_hz --hold performance/frame_rate>=60 --from 2e8 --to 1e8",
              "clocks.core_hz: nothing between 200000000 and 100000000; it takes an integer from 1 to "
              "10000000000"},
        Wrong{"least link.host_pixel_rate --set link.host_pixel_rate=0 --hold performance/frame_rate>=60",
              "link.host_pixel_rate is 0: --from and --to have to say where to look"},
        Wrong{"least clocks.core_hz --hold performance/frame_rate>=60 --from -1 --to 1e8",
              "--from must be above 0"},
        Wrong{"least clocks.core_hz --hold performance/frame_rate>=60 --from nan --to 1e8",
              "--from must be a number"},
        Wrong{"least clocks.core_hz --hold performance/frame_rate>=60 --from 1 --to inf",
              "--to must be a number"},
        Wrong{"least clocks.core_hz --hold performance/frame_rate>=inf",
              "--hold performance/frame_rate>=inf: 'inf' is no number"},
        Wrong{"least clocks.core_hz --hold devices/zynq_7020/fits>=1",
              "--hold devices/zynq_7020/fits>=1: devices/zynq_7020/fits needs a device, and none is named"},
        Wrong{"least clocks.core_hz --device zynq-7045 --hold devices/zynq_7020/fits>=1",
              "--hold devices/zynq_7020/fits>=1: devices/zynq_7020/fits is not of the device that is named: "
              "zynq-7045"},
        Wrong{"least clocks.core_hz",
              "ask least clocks.core_hz: --hold has to say what must hold, as performance/frame_rate>=60"},
        Wrong{"least resources/lut --hold performance/frame_rate>=60",
              "resources/lut is no key; if it is a number, --vary has to say of which machines"},
        Wrong{"least clocks.core_hz clocks.memory_hz",
              "ask least: takes one key, or with --vary one number; there are 2"},
        Wrong{"least resources/lut --vary clocks.core_hz=1e8 --from 3",
              "--from and --to say where to look for a key; --vary has its values"},
        Wrong{
            "least resources/luts --vary clocks.core_hz=1e8",
            "ask least: no number of a run or an estimate is called resources/luts, and no key that varies; "
            "the nearest is resources/lut (parallax glossary)"},
        Wrong{"least matching.cost --vary matching.cost=hamming --rectified --size 64x48 --timing-frames 1",
              "ask least matching.cost: 'hamming' is no number"},
        Wrong{"effect matching.parallelism=64 --hold performance/frame_rate>=60",
              "ask effect: shows two runs; --hold, --vary, --from and --to are for least and most"},
        Wrong{"effect matching.parallelism", "ask effect matching.parallelism: must have the form KEY=VALUE"},
        Wrong{"effect matching.parallelsm=64",
              "--set matching.parallelsm=64: unknown key matching.parallelsm; the nearest is "
              "matching.parallelism"},
        Wrong{"least clocks.core_hz --hold limit/part>=3",
              "--hold limit/part>=3: limit/part is a word, and has no least or most"},
        Wrong{"least clocks.core_hz --hold quality/bad_1<=5",
              "--hold quality/bad_1<=5: quality/bad_1 needs images, and none are computed"},
        Wrong{"less clocks.core_hz --hold performance/frame_rate>=60",
              "ask 'less': must be least, most or effect"}));

}  // namespace ask_test
}  // namespace parallax
