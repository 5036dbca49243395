// SPDX-License-Identifier: Apache-2.0
// Explorations in shards, and the jobs that run these: together they are as one.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "tests/cli/program.hpp"

namespace parallax {
namespace shard_test {

constexpr const char* kSpec = R"(
[run]
preset = "core-alone"
rectified = true
size = "64x48"
timing-frames = 4
[vary]
clocks.core_hz = { from = 100e6, to = 160e6, step = 10e6 }
streams.default_depth = [4, 8, 8192000]
[constraints]
"performance/frame_rate" = { at_least = 3000 }
[objectives]
"performance/frame_rate" = "most"
)";

class Shards : public ::testing::Test {
 protected:
  Shards() {
    program.folder().write("s.toml", kSpec);
    whole = program("explore s.toml --out one --json");
  }

  void expect_as_one(const std::string& folder) const {
    EXPECT_EQ(program.read(folder + "/points.csv"), program.read("one/points.csv"));
    EXPECT_EQ(program.read(folder + "/front.csv"), program.read("one/front.csv"));
  }

  // Runs a line of shell in the folder; returns its exit code.
  int shell(const std::string& line) const {
    return std::system(
        ("cd '" + program.folder().path().string() + "' && " + line + " >shell.txt 2>&1").c_str());
  }

  const test::Program program;
  test::Outcome whole;
};

TEST_F(Shards, MergedAreAsOne) {
  ASSERT_EQ(whole.code, 0) << whole.err;
  for (const char* shard : {"1", "2", "3"})
    ASSERT_EQ(program(std::string("explore s.toml --out part") + shard + " --shard " + shard + "/3").code, 0);
  const test::Outcome merged = program("merge s.toml part1 part2 part3 --out all --json");
  EXPECT_EQ(merged.code, 0) << merged.err;
  nlohmann::json expected = nlohmann::json::parse(whole.out);
  expected["evaluated"] = 0;
  EXPECT_EQ(nlohmann::json::parse(merged.out), expected);
  expect_as_one("all");
  // Again, and in another order: the same.
  EXPECT_EQ(program("merge s.toml part3 part1 part2 part2 --out all").code, 0);
  expect_as_one("all");
  EXPECT_EQ(nlohmann::json::parse(program("explore s.toml --out all --json").out)["evaluated"], 0);
}

TEST_F(Shards, SayWhatIsMissing) {
  ASSERT_EQ(program("explore s.toml --out part1 --shard 1/2").code, 0);
  const test::Outcome merged = program("merge s.toml part1 --out all");
  EXPECT_EQ(merged.code, 1);
  EXPECT_EQ(merged.err,
            "parallax: note: 6 of 21 points are missing; parallax explore s.toml --out all evaluates them\n");
  // Four more are impossible, which takes no run to say. What is there stays, and the rest is evaluated.
  EXPECT_EQ(nlohmann::json::parse(program("explore s.toml --out all --json").out)["evaluated"], 6);
  expect_as_one("all");
}

TEST_F(Shards, SurviveTheirEndAtAnyMoment) {
  std::mt19937 random(7);
  for (int round = 0; round < 9; ++round) {
    const std::string shard = std::to_string(round % 3 + 1);
    const pid_t child = program.start("explore s.toml --out part" + shard + " --shard " + shard + "/3");
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 250));
    ::kill(child, SIGKILL);
    program.wait(child);
  }
  for (const char* shard : {"1", "2", "3"})
    ASSERT_EQ(program(std::string("explore s.toml --out part") + shard + " --shard " + shard + "/3").code, 0);
  for (int round = 0; round < 4; ++round) {
    const pid_t child = program.start("merge s.toml part1 part2 part3 --out all");
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 100));
    ::kill(child, SIGKILL);
    program.wait(child);
  }
  EXPECT_EQ(program("merge s.toml part1 part2 part3 --out all").code, 0);
  expect_as_one("all");
}

// A failure of one computer does not stand where another has the result.
TEST_F(Shards, ResultsStandAgainstFailures) {
  ASSERT_EQ(program("explore s.toml --out part1 --shard 1/2").code, 0);
  ASSERT_EQ(program("explore s.toml --out part2 --shard 2/2").code, 0);
  ASSERT_EQ(program("explore s.toml --out failed --shard 2/2").code, 0);
  ASSERT_EQ(
      shell("sqlite3 failed/results.db \"UPDATE result SET status = 'failed', message = 'out of memory'; "
            "DELETE FROM metric\""),
      0)
      << program.read("shell.txt");
  EXPECT_EQ(program("merge s.toml part1 failed part2 --out all").code, 0);
  expect_as_one("all");
}

// GNU Parallel itself; the other two engines by what they tell a task.
TEST_F(Shards, AreTasksOfAnEngine) {
  const auto emit = [this](const std::string& engine) {
    const test::Outcome outcome =
        program("explore s.toml --out " + engine + " --emit " + engine + " --tasks 3 --json");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  };
  const nlohmann::json parallel = emit("parallel");
  EXPECT_EQ(parallel["points"], 21);
  EXPECT_EQ(shell(parallel["submit"]), 0) << program.read("shell.txt");
  emit("lsf");
  emit("sge");
  for (const char* task : {"1", "2", "3"}) {
    EXPECT_EQ(shell(std::string("LSB_JOBINDEX=") + task + " bash lsf/job.lsf"), 0)
        << program.read("shell.txt");
    EXPECT_EQ(shell(std::string("SGE_TASK_ID=") + task + " bash sge/job.sge"), 0)
        << program.read("shell.txt");
  }
  for (const std::string engine : {"parallel", "lsf", "sge"}) {
    EXPECT_EQ(program("merge s.toml " + engine + "/shards/1 " + engine + "/shards/2 " + engine +
                      "/shards/3 --out " + engine)
                  .code,
              0);
    expect_as_one(engine);
  }
  EXPECT_NE(shell("bash sge/job.sge"), 0) << "outside its engine";
  EXPECT_NE(program.read("shell.txt").find("start this with qsub"), std::string::npos);
}

struct Wrong {
  const char* arguments;
  const char* line;
};

void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.arguments; }

class WrongShard : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongShard, IsOneLineAndLeavesNothing) {
  const test::Program program;
  program.folder().write("s.toml", kSpec);
  program.folder().write("search.toml", std::string(kSpec) + "[sampling]\nmethod = 'search'\npoints = 9\n");
  program.folder().write("other/results.db",
                         "no database, and longer than the header of one, which has 100 bytes; "
                         "so that it is read, and not taken for an empty one");
  const test::Outcome outcome = program(GetParam().arguments);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err, std::string("parallax: error: ") + GetParam().line + "\n");
  EXPECT_EQ(program.files("out"), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(
    Of, WrongShard,
    ::testing::Values(
        Wrong{"explore s.toml --out out --shard 0/4", "--shard '0/4': must be NUMBER/PARTS, as 1/4 to 4/4"},
        Wrong{"explore s.toml --out out --shard 5/4", "--shard '5/4': must be NUMBER/PARTS, as 1/4 to 4/4"},
        Wrong{"explore s.toml --out out --shard 1", "--shard '1': must be NUMBER/PARTS, as 1/4 to 4/4"},
        Wrong{"explore s.toml --out out --shard -1/4", "--shard '-1/4': must be NUMBER/PARTS, as 1/4 to 4/4"},
        Wrong{"explore s.toml --out out --shard 1/4/2",
              "--shard '1/4/2': must be NUMBER/PARTS, as 1/4 to 4/4"},
        Wrong{"explore search.toml --out out --shard 1/2",
              "search.toml: a search cannot be shared: each of its points follows from those before"},
        Wrong{"explore search.toml --out out --emit sge --tasks 2",
              "--emit: a search cannot be shared: each of its points follows from those before"},
        Wrong{"explore s.toml --out out --emit pbs --tasks 2",
              "--emit 'pbs': must be slurm, parallel, lsf or sge"},
        Wrong{"explore s.toml --out out --emit slurm", "--emit needs --tasks: how many tasks the job has"},
        Wrong{"explore s.toml --out out --tasks 4", "--tasks says how many --emit writes a job for"},
        Wrong{"explore s.toml --out out --emit slurm --tasks 4 --shard 1/2",
              "--emit and --shard exclude each other: each task has its shard"},
        Wrong{"explore s.toml --out out --emit slurm --tasks 1001",
              "--tasks 1001: slurm takes no more than 1000; fewer tasks of more points do the same"},
        Wrong{"explore s.toml --out out --emit lsf --tasks 22",
              "--tasks 22: there are 21 points; a task has one or more"},
        Wrong{"merge s.toml none --out out", "none: no results.db in it: not the folder of an exploration"},
        Wrong{"merge s.toml other --out other",
              "other: is the folder that is written; the others are merged into it"}));

TEST(WrongMerge, OfAnotherExplorationOrNoneAtAll) {
  const test::Program program;
  program.folder().write("s.toml", kSpec);
  std::string other = kSpec;
  other.replace(other.find("[4, 8, 8192000]"), 15, "[8, 4, 8192000]");
  program.folder().write("other.toml", other);
  ASSERT_EQ(program("explore other.toml --out part --shard 1/9").code, 0);
  const test::Outcome outcome = program("merge s.toml part --out all");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err, "parallax: error: part/results.db: has nothing of this exploration\n");
  program.folder().write("bad/results.db", std::string(4096, 'x'));
  const test::Outcome damaged = program("merge s.toml bad --out all");
  EXPECT_EQ(damaged.code, 2);
  EXPECT_EQ(damaged.err, "parallax: error: bad/results.db: file is not a database\n");
}

}  // namespace shard_test
}  // namespace parallax
