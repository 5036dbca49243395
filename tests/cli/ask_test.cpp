// SPDX-License-Identifier: Apache-2.0
// One question to a machine, and the runs that answer it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

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
        Wrong{"least clocks.core_hz --hold performance/framerate>=60",
              "--hold performance/framerate>=60: no number of a run is called performance/framerate; the "
              "nearest is "
              "performance/frame_rate (parallax glossary)"},
        Wrong{"least clocks.core_hz --hold performance/frame_rate>=60 --from 2e8 --to 1e8",
              "clocks.core_hz: nothing between 200000000 and 100000000; it takes an integer from 1 to "
              "10000000000"},
        Wrong{"least link.host_pixel_rate --set link.host_pixel_rate=0 --hold performance/frame_rate>=60",
              "link.host_pixel_rate is 0: --from and --to have to say where to look"},
        Wrong{"least clocks.core_hz --hold performance/frame_rate>=60 --from -1 --to 1e8",
              "--from must be above 0"},
        Wrong{"least clocks.core_hz --hold performance/frame_rate>=60 --hold memory/share<=50",
              "--hold: At Most 1 required but received 2"},
        Wrong{"least clocks.core_hz --hold limit/part>=3",
              "--hold limit/part>=3: limit/part is a word, and has no bounds"},
        Wrong{"least clocks.core_hz --hold quality/bad_1<=5",
              "--hold quality/bad_1<=5: quality/bad_1 needs images, and none are computed"},
        Wrong{"less clocks.core_hz --hold performance/frame_rate>=60", "ask 'less': must be least or most"}));

}  // namespace ask_test
}  // namespace parallax
