// SPDX-License-Identifier: Apache-2.0
// `parallax run --timing-only --vary`: a grid of configurations over one input.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "tests/cli/program.hpp"

namespace parallax {
namespace vary_test {

using nlohmann::json;

class Vary : public ::testing::Test {
 protected:
  json points(const std::string& arguments, int code = 0) const {
    const test::Outcome outcome = program_("run --timing-only -q --json " + arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return json::parse(outcome.out, nullptr, false);
  }

  static json timing(json tree) {
    for (const char* name : {"command", "wall_time", "speed", "peak_memory"}) tree["run"].erase(name);
    return tree;
  }

  // Each point is the run with the same values given by --set.
  void expect_as_single_runs(const std::string& input, const std::string& axes) const {
    SCOPED_TRACE(axes);
    const json all = points(input + axes);
    for (const json& point : all) {
      ASSERT_EQ(point["status"], "done") << point;
      std::string assignments;
      for (const auto& [key, value] : point["set"].items())
        assignments += " --set " + key + "=" + value.dump();
      const test::Outcome single =
          program_("run --timing-only --no-verdict -q --json " + input + assignments);
      ASSERT_EQ(single.code, 0) << single.err;
      const json differences = json::diff(timing(json::parse(single.out)), timing(point["timing"]));
      EXPECT_TRUE(differences.empty()) << assignments << ": " << differences.front();
    }
  }

  std::string error(const std::string& arguments) const {
    const test::Outcome outcome = program_("run --size 64x48 " + arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.out;
    EXPECT_EQ(outcome.out, "");
    const std::string prefix = "parallax: error: ";
    EXPECT_EQ(outcome.err.rfind(prefix, 0), 0U) << outcome.err;
    EXPECT_EQ(test::lines(outcome.err).size(), 1U) << outcome.err;
    return outcome.err.substr(prefix.size(), outcome.err.size() - prefix.size() - 1);
  }

  test::Program program_;
};

TEST_F(Vary, EachPointIsTheRunWithTheseValues) {
  const std::string scene = "--size 96x64 -d 32";
  expect_as_single_runs(scene, " --vary clocks.core_hz=50000000,175000000 --vary matching.latency=1,200");
  expect_as_single_runs(scene, " --vary streams.left_output.depth=0,20000 --vary memory.latency_cycles=1,99");
}

TEST_F(Vary, TheInputIsMadeAnewWhereItDependsOnAKey) {
  const std::string scene = "--size 90x50";
  expect_as_single_runs(scene, " --vary rectification.window=41,79 --vary image.width_granularity=2,32");
  expect_as_single_runs(scene, " --vary rectification.fraction_bits=3,5 --vary matching.iterations=1,2");
  expect_as_single_runs("--set image.height=48", " --vary image.width=64,96");
  ASSERT_EQ(program_("scene --size 70x50 --disparities 32 --out in").code, 0);
  expect_as_single_runs("-d 32 --left in/left.png --right in/right.png --calibration in/calib.yml",
                        " --vary rectification.window=61,79 --vary image.max_width=70,1856");
}

TEST_F(Vary, TheLastKeyChangesFastestAndValuesKeepTheirType) {
  const json all = points(
      "--size 64x48 -d 32 --timing-frames 1 --vary texture.enabled=true,false "
      "--vary matching.paths=\"w,n\",n --vary memory.latency_cycles=1,2");
  ASSERT_EQ(all.size(), 8U);
  EXPECT_EQ(all[0]["set"],
            json({{"texture.enabled", true}, {"matching.paths", "w,n"}, {"memory.latency_cycles", 1}}));
  EXPECT_EQ(all[1]["set"]["memory.latency_cycles"], 2);
  EXPECT_EQ(all[2]["set"]["matching.paths"], "n");
  EXPECT_EQ(all[4]["set"]["texture.enabled"], false);
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i]["point"], i);
  EXPECT_EQ(all[5]["timing"]["configuration"]["memory"]["latency_cycles"], 2);
  EXPECT_EQ(all[5]["timing"]["configuration"]["texture"]["enabled"], false);
}

TEST_F(Vary, APointThatIsStuckOrInvalidIsARowAndTheOthersAreMeasured) {
  const std::string grid =
      "--size 64x48 -d 32 --vary streams.left_texture.depth=0,8 --vary clocks.core_hz=1e8,-3";
  const json all = points(grid, 1);
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[0]["status"], "done");
  EXPECT_FALSE(all[0].contains("message"));
  EXPECT_EQ(all[1]["status"], "invalid");
  EXPECT_EQ(all[1]["message"],
            "--set clocks.core_hz=-3: clocks.core_hz = -3: must be an integer from 1 to 10000000000");
  EXPECT_FALSE(all[1].contains("timing"));
  EXPECT_EQ(all[2]["status"], "stuck");
  EXPECT_EQ(all[2]["message"].get<std::string>().rfind("the machine is deadlocked; nobody in this circle", 0),
            0U);
  EXPECT_EQ(all[3]["status"], "invalid");

  const test::Outcome table = program_("run --timing-only " + grid + " --out out");
  EXPECT_EQ(table.code, 1);
  EXPECT_EQ(table.err, "");
  const auto rows = test::lines(table.out);
  ASSERT_EQ(rows.size(), 5U) << table.out;
  EXPECT_EQ(rows[0], "point  streams.left_texture.depth  clocks.core_hz   frame rate      latency  limit");
  EXPECT_EQ(rows[1].rfind("    0                           0             1e8 ", 0), 0U) << rows[1];
  EXPECT_NE(rows[1].find(" fps "), std::string::npos) << rows[1];
  EXPECT_NE(rows[1].find(" ms  "), std::string::npos) << rows[1];
  EXPECT_NE(rows[2].find("  invalid: --set clocks.core_hz=-3: "), std::string::npos) << rows[2];
  EXPECT_NE(rows[3].find("  stuck: "), std::string::npos) << rows[3];
  EXPECT_EQ(program_.files("out"),
            (std::vector<std::string>{"point_0000/", "point_0000/timing.json", "results.db"}));
  const json file = json::parse(program_.read("out/point_0000/timing.json"));
  EXPECT_EQ(timing(file), timing(all[0]["timing"]));
}

TEST_F(Vary, QuietSaysNothing) {
  const test::Outcome outcome =
      program_("run --timing-only -q --size 64x48 -d 32 --vary clocks.core_hz=1e8,-3");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(Vary, ANoteIsSaidOnce) {
  const test::Outcome outcome =
      program_("run --timing-only --size 70x48 -d 32 --timing-frames 1 --vary rectification.window=41,61,79");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(test::lines(outcome.err).size(), 1U) << outcome.err;
  EXPECT_EQ(outcome.err.rfind("parallax: note: image size 70x48", 0), 0U) << outcome.err;
}

TEST_F(Vary, WhatIsWrongWithTheGridIsOneError) {
  EXPECT_EQ(error("--vary clocks.core_hz=1e8"), "--vary needs --timing-only");
  const std::string run = "--timing-only -d 32 ";
  for (const std::string bad :
       {"clocks.core_hz", "clocks.core_hz=", "=5", "clocks.core_hz=1,,2", "clocks.core_hz=1,"}) {
    EXPECT_EQ(error(run + "--vary " + bad), "--vary " + bad + ": must have the form key=value,value,...");
  }
  EXPECT_EQ(error(run + "--vary clocks.cor_hz=1"),
            "--vary clocks.cor_hz=1: unknown key clocks.cor_hz; the nearest is clocks.core_hz");
  EXPECT_EQ(error(run + "--vary clocks.core_hz=1,2 --vary clocks.core_hz=3"),
            "--vary clocks.core_hz=3: clocks.core_hz is varied twice");
  EXPECT_EQ(error(run + "--vary matching.iterations=1,2"),
            "--vary matching.iterations and --disparities exclude each other: both set the range");
  std::string many = "1";
  for (int i = 2; i <= 400; ++i) many += "," + std::to_string(i);
  EXPECT_EQ(error(run + "--vary memory.latency_cycles=" + many + " --vary matching.latency=" + many),
            "--vary: more than 100000 combinations");
  EXPECT_EQ(error(run + "--vary clocks.core_hz=1e8 --out ''"), "--out: the value is empty");
  const test::Outcome images =
      program_("run --timing-only --left none.png --right none.png --vary clocks.core_hz=1e8,2e8 --out out");
  EXPECT_EQ(images.code, 2);
  EXPECT_EQ(images.err, "parallax: error: image none.png does not exist\n");
  EXPECT_EQ(program_.files(), std::vector<std::string>{});
}

// Ended at any moment, a sweep goes on with the rest, and shows all of it; what is there stays.
TEST_F(Vary, GoesOnWhereItWasEnded) {
  const std::string sweep =
      "run --timing-only --size 64x48 -d 32 --timing-frames 6 --vary clocks.core_hz=1e8:2e8:1e7,-1 "
      "--vary streams.left_texture.depth=0,1 --out ";
  const test::Outcome whole = program_(sweep + "one");
  ASSERT_EQ(whole.code, 1) << whole.err;
  std::mt19937 random(3);
  std::map<std::string, std::filesystem::file_time_type> written;
  for (int round = 0; round < 5; ++round) {
    const pid_t child = program_.start(sweep + "out");
    // First once there is something to keep.
    for (int i = 0;
         round == 0 && i < 6000 && !std::filesystem::exists(program_ / "out/point_0002/timing.json"); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 200));
    ::kill(child, SIGKILL);
    program_.wait(child);
    for (const auto& [name, when] : written)
      EXPECT_EQ(std::filesystem::last_write_time(program_ / name), when) << "made again: " << name;
    for (const std::string& name : program_.files("out")) {
      const std::string path = "out/" + name;
      // What was being written when it was killed is made again.
      if (name.size() > 11 && name.substr(11) == "timing.json" && round < 4) {
        SQLite::Database database((program_ / "out/results.db").string());
        const int point = std::stoi(name.substr(6, 4));
        if (database.execAndGet("SELECT count(*) FROM point WHERE number = " + std::to_string(point))
                .getInt() == 1)
          written.emplace(path, std::filesystem::last_write_time(program_ / path));
      }
    }
  }
  EXPECT_FALSE(written.empty());
  const test::Outcome last = program_(sweep + "out");
  EXPECT_EQ(last.code, 1);
  EXPECT_EQ(last.out, whole.out);
  EXPECT_EQ(program_.files("out"), program_.files("one"));
  for (const auto& [name, when] : written)
    EXPECT_EQ(std::filesystem::last_write_time(program_ / name), when) << "made again: " << name;
  // As JSON, too; and a file that somebody took away is made again.
  std::filesystem::remove(program_ / "out/point_0000/timing.json");
  const json all = json::parse(program_(sweep + "out --json").out);
  ASSERT_EQ(all.size(), 24U);
  EXPECT_EQ(all[0]["status"], "done");
  EXPECT_EQ(all[1]["status"], "stuck");
  EXPECT_EQ(all[23]["status"], "invalid");
  EXPECT_TRUE(std::filesystem::exists(program_ / "out/point_0000/timing.json"));
}

class VaryInterrupted : public Vary, public ::testing::WithParamInterface<int> {};

TEST_P(VaryInterrupted, LeavesTheFinishedPointsWhole) {
  std::string many = "1";
  for (int i = 2; i <= 300; ++i) many += "," + std::to_string(i);  // squared, hours of points
  const pid_t child =
      program_.start("run --timing-only --size 64x48 -d 32 --out out --vary matching.latency=" + many +
                     " --vary memory.latency_cycles=" + many);
  for (int i = 0; i < 6000 && !std::filesystem::exists(program_ / "out/point_0001/timing.json"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ::kill(child, GetParam());
  const test::Outcome outcome = program_.wait(child);
  EXPECT_EQ(outcome.code, 128 + GetParam()) << outcome.err;
  const std::size_t points = test::lines(outcome.out).size() - 1;
  EXPECT_GE(points, 2U);
  EXPECT_EQ(outcome.err, "parallax: interrupted after " + std::to_string(points) + " of 90000 points\n");
  EXPECT_EQ(program_.files("out").size(), 2 * points + 1);
  EXPECT_FALSE(json::parse(program_.read("out/point_0001/timing.json")).empty());
}

INSTANTIATE_TEST_SUITE_P(By, VaryInterrupted, ::testing::Values(SIGINT, SIGTERM));

}  // namespace vary_test
}  // namespace parallax
