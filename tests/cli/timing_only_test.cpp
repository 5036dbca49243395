// SPDX-License-Identifier: Apache-2.0
// `parallax run --timing-only` says what the full run says of time, to the last digit.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"
#include "tests/paths.hpp"

namespace parallax {
namespace timing_only_test {

using nlohmann::json;

class TimingOnly : public ::testing::Test {
 protected:
  json run(const std::string& arguments) const {
    const test::Outcome outcome = program_("run -q --json --no-verdict " + arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return json::parse(outcome.out, nullptr, false);
  }

  // What is left does not depend on the computer, nor on the values of pixels.
  static json timing(json tree) {
    for (const char* name : {"command", "wall_time", "speed", "peak_memory"}) tree["run"].erase(name);
    tree["input"].erase("frames_with_images");
    tree.erase("quality");
    return tree;
  }

  void expect_same(const std::string& arguments) const {
    SCOPED_TRACE(arguments);
    const json full = run(arguments);
    const json only = run("--timing-only " + arguments);
    EXPECT_GT(full["input"]["frames_with_images"]["value"], 0);
    EXPECT_EQ(only["input"]["frames_with_images"]["value"], 0);
    const json differences = json::diff(timing(full), timing(only));
    EXPECT_TRUE(differences.empty()) << differences.front();
    // A comparison of nothing would hold as well.
    EXPECT_GT(full["stages"]["rectification"]["busy"]["value"], 0);
    EXPECT_GT(full["streams"]["left_output"]["occupancy"]["value"].size(), 0U);
  }

  test::Program program_;
};

TEST_F(TimingOnly, EqualsTheFullRunOfADistortedScene) { expect_same("--size 160x128 -d 64"); }

TEST_F(TimingOnly, EqualsTheFullRunOfARectifiedSequence) {
  expect_same("--size 160x128 -d 64 --rectified --frames 12");
}

TEST_F(TimingOnly, EqualsTheFullRunOfPaddedImages) { expect_same("--size 101x75 -d 64 --frames 3"); }

TEST_F(TimingOnly, EqualsTheFullRunAt256Disparities) { expect_same("--size 320x128 -d 256"); }

TEST_F(TimingOnly, EqualsTheFullRunOfASingleFrame) { expect_same("--size 128x96 -d 32 --timing-frames 1"); }

TEST_F(TimingOnly, EqualsTheFullRunOfSecondPassesAndSlowMemory) {
  expect_same(
      "--size 128x96 -d 32 --set matching.paths=w,nw,n,ne,e,sw,s,se --set memory.model=bus --set "
      "memory.bytes_per_cycle=1 "
      "--set clocks.memory_hz=60e6 --set rectification.window=41");
}

TEST_F(TimingOnly, EqualsTheFullRunOfFiles) {
  ASSERT_EQ(program_("scene --size 130x90 --disparities 64 --frames 2 --out in").code, 0);
  expect_same("--input in -d 64 --calibration in/calib.yml");
  ASSERT_EQ(program_("map encode --calibration in/calib.yml -o lens.map").code, 0);
  expect_same("--input in -d 64 --map lens.map");
}

TEST_F(TimingOnly, EqualsTheFullRunOfALargeRealPair) {
  const std::string folder = test::shared_data("euroc_v101/");
  if (!std::filesystem::exists(folder + "calib.yml")) GTEST_SKIP() << "no stereo data here";
  expect_same("--timing-frames 2 -d 64 --left " + folder + "left_00.png --right " + folder +
              "right_00.png --fit --calibration " + folder + "calib.yml");
}

TEST_F(TimingOnly, TheMapsBytesChangeTheTime) {
  const json distorted = run("--timing-only --size 160x128 -d 32");
  const json straight = run("--timing-only --size 160x128 -d 32 --rectified");
  EXPECT_NE(distorted["streams"]["map_words"]["tokens"], straight["streams"]["map_words"]["tokens"]);
}

TEST_F(TimingOnly, WritesTheTimingAlone) {
  const test::Outcome outcome = program_("run --timing-only --size 64x48 -d 32 --frames 2 --out out");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(program_.files("out"), (std::vector<std::string>{"profile.json", "timing.json"}));
  EXPECT_EQ(outcome.out.find("valid pixels"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("frame rate"), std::string::npos) << outcome.out;
}

TEST_F(TimingOnly, ReadsNoImageButTheFirstPair) {
  ASSERT_EQ(program_("scene --size 64x48 --disparities 32 --frames 3 --out in").code, 0);
  std::filesystem::path second;
  for (const std::string& name : program_.files("in")) {
    if (name.find("left") != std::string::npos && name.find("1.png") != std::string::npos) {
      second = program_ / ("in/" + name);
    }
  }
  ASSERT_FALSE(second.empty());
  std::filesystem::resize_file(second, 100);
  EXPECT_EQ(program_("run -q -d 32 --input in").code, 2);
  EXPECT_EQ(program_("run -q -d 32 --input in --timing-only").code, 0);
}

TEST_F(TimingOnly, TakesLessThan150MegabytesAtTheLargestSize) {
  if (test::sanitized()) GTEST_SKIP() << "the sanitizer has memory of its own";
  EXPECT_LT(run("--timing-only --size 1728x1856 -d 256")["run"]["peak_memory"]["value"], 150.0);
  // One that has to be padded.
  EXPECT_LT(run("--timing-only --size 1720x1850 -d 256")["run"]["peak_memory"]["value"], 150.0);
}

}  // namespace timing_only_test
}  // namespace parallax
