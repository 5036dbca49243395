// SPDX-License-Identifier: Apache-2.0
// `parallax run --timing-only --vary` over options, over ranges, and with --relax.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace parallax::test {
namespace vary_options_test {

using nlohmann::json;

class VaryOptions : public testing::Test {
 protected:
  json points(const std::string& arguments, int code = 0) const {
    const Outcome outcome = program_("run --timing-only -q --json " + arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return json::parse(outcome.out, nullptr, false);
  }

  // The command of a point says what the point says; it may add the verdict.
  void expect_reproducible(const json& all) const {
    for (const json& point : all) {
      const std::string command = point["command"];
      SCOPED_TRACE(command);
      ASSERT_EQ(command.rfind("parallax ", 0), 0U);
      const Outcome single = program_(command.substr(9) + " --no-verdict");
      ASSERT_EQ(point["status"], "done");
      ASSERT_EQ(single.code, 0) << single.err;
      json alone = json::parse(single.out);
      json swept = point["timing"];
      EXPECT_EQ(swept["run"]["command"]["value"], command);
      alone.erase("run");
      swept.erase("run");
      const json differences = json::diff(alone, swept);
      EXPECT_TRUE(differences.empty()) << differences.front();
    }
  }

  std::string error(const std::string& arguments) const {
    const Outcome outcome = program_("run --timing-only " + arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.out;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(lines(outcome.err).size(), 1U) << outcome.err;
    return outcome.err.substr(0, outcome.err.size() - 1);
  }

  Program program_;
};

TEST_F(VaryOptions, SizePresetAndRangeAreThoseOfTheRunsAlone) {
  const json all = points(
      "--rectified --vary size=64x48,96x32 --vary preset=scenescan-pro,core-alone --vary "
      "disparities=32:64:32");
  ASSERT_EQ(all.size(), 8U);
  EXPECT_EQ(all[0]["options"], json({{"size", "64x48"}, {"preset", "scenescan-pro"}, {"disparities", "32"}}));
  EXPECT_EQ(all[7]["options"], json({{"size", "96x32"}, {"preset", "core-alone"}, {"disparities", "64"}}));
  EXPECT_FALSE(all[0].contains("set"));
  expect_reproducible(all);
}

TEST_F(VaryOptions, InputsWithTheirCalibrationsAndMaps) {
  ASSERT_EQ(program_("scene --size 64x48 --disparities 32 --out raw").code, 0);
  ASSERT_EQ(program_("scene --rectified --size 96x64 --disparities 32 --frames 2 --out flat").code, 0);
  ASSERT_EQ(std::rename((program_ / "raw/left.png").c_str(), (program_ / "raw/left_00.png").c_str()), 0);
  ASSERT_EQ(std::rename((program_ / "raw/right.png").c_str(), (program_ / "raw/right_00.png").c_str()), 0);
  json all = points("-d 32 --vary input=raw,\"flat\" --vary streams.left_output.depth=0,20000");
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[3]["options"], json({{"input", "flat"}}));
  EXPECT_EQ(all[3]["set"], json({{"streams.left_output.depth", 20000}}));
  EXPECT_EQ(all[0]["timing"]["input"]["width"]["value"], 64);
  EXPECT_EQ(all[2]["timing"]["input"]["width"]["value"], 96);
  expect_reproducible(all);

  all = points("-d 32 --input raw --vary calibration=raw/calib.yml");
  ASSERT_EQ(all.size(), 1U);
  expect_reproducible(all);
}

TEST_F(VaryOptions, ManyInputsAreOpenedAnew) {
  const json all = points(
      "-d 32 --rectified --vary matching.latency=1,50 --vary size=64x48,32x32,96x48,64x32,32x48,64x64");
  ASSERT_EQ(all.size(), 12U);
  expect_reproducible(all);
}

TEST_F(VaryOptions, ARangeIsEachOfItsNumbers) {
  const json all = points(
      "--size 64x48 -d 32 --timing-frames 1 --vary clocks.core_hz=50e6:150e6:50e6,3e8 "
      "--vary memory.latency_cycles=9:5:-2");
  ASSERT_EQ(all.size(), 12U);
  EXPECT_EQ(all[0]["set"], json({{"clocks.core_hz", 50e6}, {"memory.latency_cycles", 9}}));
  EXPECT_EQ(all[5]["set"], json({{"clocks.core_hz", 100e6}, {"memory.latency_cycles", 5}}));
  EXPECT_EQ(all[11]["set"], json({{"clocks.core_hz", 3e8}, {"memory.latency_cycles", 5}}));
  EXPECT_EQ(all[4]["timing"]["configuration"]["clocks"]["core_hz"], 100'000'000);
}

// A text may have colons.
TEST_F(VaryOptions, OnlyNumbersHaveRanges) {
  const json all = points("--size 64x48 -d 32 --timing-frames 1 --vary memory.device=a:b:c", 1);
  EXPECT_EQ(all[0]["set"]["memory.device"], "a:b:c");
  EXPECT_EQ(all[0]["status"], "invalid");
}

TEST_F(VaryOptions, AValueThatIsNoneIsARow) {
  const json all = points(
      "--rectified --vary size=x,64x48 --vary preset=none,scenescan-pro --vary disparities=many,32", 1);
  ASSERT_EQ(all.size(), 8U);
  for (std::size_t i = 0; i + 1 < all.size(); ++i) EXPECT_EQ(all[i]["status"], "invalid") << i;
  EXPECT_EQ(all[7]["status"], "done");
  EXPECT_EQ(all[3]["message"], "--size: 'x' is not a size such as 640x480");
  EXPECT_EQ(all[6]["message"], "--disparities: 'many' is not a whole number");
  EXPECT_NE(all[5]["message"].get<std::string>().find("no preset 'none' in "), std::string::npos);
  EXPECT_EQ(all[5]["command"],
            "parallax run --timing-only -q --json --rectified --size 64x48 --preset none --disparities 32");
  EXPECT_EQ(program_("run --timing-only -d 32 --vary input=none,64x48 --out o").err,
            "parallax: error: none does not exist; expected a folder or a list of image pairs\n");
  EXPECT_EQ(program_.files(), std::vector<std::string>{});
}

TEST_F(VaryOptions, WhatIsWrongIsOneError) {
  const std::string before = "parallax: error: ";
  EXPECT_EQ(error("--size 64x48 --vary size=32x32"), before + "--vary size and --size exclude each other");
  EXPECT_EQ(error("-d 32 --vary disparities=32"),
            before + "--vary disparities and --disparities exclude each other");
  EXPECT_EQ(error("-p core-alone --vary preset=core-alone"),
            before + "--vary preset and --preset exclude each other");
  EXPECT_EQ(error("--input a --vary input=b"), before + "--vary input and --input exclude each other");
  EXPECT_EQ(error("--map a --vary map=b"), before + "--vary map and --map exclude each other");
  EXPECT_EQ(error("--input a --calibration c --vary calibration=b"),
            before + "--vary calibration and --calibration exclude each other");
  EXPECT_EQ(error("--vary disparities=32 --vary matching.iterations=1"),
            before + "--vary matching.iterations and --disparities exclude each other: both set the range");
  EXPECT_EQ(error("--size 64x48 --vary input=a"),
            before + "--size and --rectified are for the built-in scene, but images are given");
  EXPECT_EQ(error("--vary sise=64x48"), before + "--vary sise=64x48: unknown key sise; the nearest is size");
  EXPECT_EQ(error("--vary size=64x48,"),
            before + "--vary size=64x48,: must have the form key=value,value,...");
  EXPECT_EQ(error("--vary memory.latency_cycles=1:5"),
            before +
                "--vary memory.latency_cycles=1:5: '1:5' is no range: it must have the form "
                "start:stop:step, three numbers such as 10:100:5");
  EXPECT_EQ(error("--vary memory.latency_cycles=1:5:0"),
            before + "--vary memory.latency_cycles=1:5:0: the step of '1:5:0' is 0");
  EXPECT_EQ(
      error("--vary disparities=64:32:32"),
      before + "--vary disparities=64:32:32: '64:32:32' never comes to its end: the step must be negative");
  EXPECT_EQ(error("--vary memory.latency_cycles=1:100001:1"),
            before + "--vary memory.latency_cycles=1:100001:1: '1:100001:1' has more than 100000 values");
  EXPECT_EQ(error("--vary memory.latency_cycles=1:400:1 --vary matching.latency=1:400:1"),
            before + "--vary: more than 100000 combinations");
}

TEST_F(VaryOptions, NoInputIsWrittenOver) {
  ASSERT_EQ(program_("scene --rectified --size 64x48 --disparities 32 --out point_0000").code, 0);
  ASSERT_EQ(std::rename((program_ / "point_0000/left.png").c_str(), (program_ / "left.png").c_str()), 0);
  ASSERT_EQ(
      std::rename((program_ / "point_0000/right.png").c_str(), (program_ / "point_0000/timing.json").c_str()),
      0);
  std::ofstream(program_ / "pair.txt") << "left.png point_0000/timing.json\n";
  std::ofstream(program_ / "none.txt") << "left.png none.png\n";
  const std::string refused = error("-d 32 --vary input=none.txt,pair.txt --out .");
  EXPECT_NE(refused.find("timing.json"), std::string::npos) << refused;
  EXPECT_NE(refused.find("--input pair.txt"), std::string::npos) << refused;
}

// Each point's limits are those of its own `--relax`.
TEST_F(VaryOptions, WithRelaxEachPointHasItsLimits) {
  const std::string grid =
      "run --timing-only --relax -d 32 --vary size=64x48,96x48 --vary link.host_pixel_rate=0,1e6 "
      "--vary streams.left_texture.depth=0,8";
  const Outcome outcome = program_(grid + " --json -q --out sweep");
  EXPECT_EQ(outcome.code, 1) << outcome.err;  // some are stuck
  const json all = json::parse(outcome.out);
  ASSERT_EQ(all.size(), 8U);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const json& point = all[i];
    if (point["status"] != "done") {
      EXPECT_EQ(point["status"], "stuck");
      EXPECT_FALSE(point.contains("relaxations"));
      continue;
    }
    const std::string command = point["command"];
    const Outcome single = program_(command.substr(9));
    ASSERT_EQ(single.code, 0) << single.err;
    EXPECT_EQ(json::parse(single.out), point["relaxations"]) << command;
    EXPECT_EQ(point["timing"]["limit"]["relaxation"]["value"], point["relaxations"]["limit"]);
    EXPECT_EQ(json::parse(program_.read(fmt::format("sweep/point_{:04}/relaxations.json", i))),
              point["relaxations"]);
  }
  EXPECT_EQ(all[2]["relaxations"]["limit"], "host");

  const auto rows = lines(program_(grid).out);
  ASSERT_EQ(rows.size(), 9U);
  EXPECT_EQ(
      rows[0],
      "point   size  link.host_pixel_rate  streams.left_texture.depth   frame rate      latency  limit, "
      "and what taking it away gains");
  EXPECT_NE(rows[3].find(" ms  host +"), std::string::npos) << rows[3];
  for (const std::string& row : rows) EXPECT_LE(row.size(), 160U) << row;
  // Another sweep there would not know which points are whose.
  const std::vector<std::string> before = program_.files("sweep");
  const test::Outcome other =
      program_("run -q --timing-only -d 32 --size 64x48 --vary matching.latency=1 --out sweep");
  EXPECT_EQ(other.code, 2);
  EXPECT_EQ(other.err.rfind(
                "parallax: error: sweep: has the results of another sweep or exploration: parallax run ", 0),
            0U)
      << other.err;
  EXPECT_NE(other.err.find("; each has a folder of its own\n"), std::string::npos) << other.err;
  EXPECT_EQ(program_.files("sweep"), before);
}

}  // namespace vary_options_test
}  // namespace parallax::test
