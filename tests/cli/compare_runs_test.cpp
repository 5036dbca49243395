// SPDX-License-Identifier: Apache-2.0
// `parallax compare-runs`: what it says of two runs, and of what is none.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/program.hpp"

namespace parallax {
namespace compare_runs_test {

using nlohmann::json;

class CompareRuns : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(program_("run --timing-only --no-verdict --size 160x128 --out a").code, 0);
    ASSERT_EQ(
        program_("run --timing-only --no-verdict --size 160x128 --set clocks.core_hz=150e6 --out b").code, 0);
  }
  std::string error(const std::string& arguments) {
    const test::Outcome outcome = program_("compare-runs " + arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.out;
    EXPECT_EQ(outcome.out, "");
    return outcome.err;
  }
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((program_ / name).parent_path());
    std::ofstream(program_ / name, std::ios::binary) << text;
  }
  test::Program program_;
};

TEST_F(CompareRuns, SaysWhatChanged) {
  const test::Outcome outcome = program_("compare-runs a b/timing.json --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json tree = json::parse(outcome.out);
  ASSERT_EQ(tree["configuration"].size(), 1U);
  EXPECT_EQ(tree["configuration"][0]["name"], "clocks/core_hz");
  EXPECT_EQ(tree["configuration"][0]["a"], 188'000'000);
  EXPECT_EQ(tree["configuration"][0]["b"], 150'000'000);
  const json a = json::parse(program_.read("a/timing.json"));
  const json b = json::parse(program_.read("b/timing.json"));
  bool rate = false;
  for (const json& difference : tree["results"]) {
    const json::json_pointer pointer("/" + difference["name"].get<std::string>() + "/value");
    const auto value = [&pointer](const json& run) {
      return run.contains(pointer) ? run.at(pointer) : json();
    };
    ASSERT_EQ(difference["a"], value(a));
    ASSERT_EQ(difference["b"], value(b));
    ASSERT_NE(difference["a"], difference["b"]);
    if (difference["name"] != "performance/frame_rate") continue;
    rate = true;
    EXPECT_NEAR(difference["change_percent"].get<double>(),
                100 * (difference["b"].get<double>() / difference["a"].get<double>() - 1), 1e-9);
  }
  EXPECT_TRUE(rate);
}

TEST_F(CompareRuns, TheTextHasTheConfigurationFirstAndEveryStageThatMoved) {
  const std::string text = program_("compare-runs a b").out;
  const auto at = [&](const char* what) { return text.find(what); };
  EXPECT_LT(at("clocks/core_hz"), at("performance/frame_rate"));
  EXPECT_LT(at("performance/frame_rate"), at("stages/matching/utilisation"));
  EXPECT_NE(at("memory/link/bandwidth"), std::string::npos);
  EXPECT_EQ(at("memory/camera_left/latency_mean"), std::string::npos);  // by less than a percent
  EXPECT_NE(program_("compare-runs a b --all").out.find("memory/camera_left/latency_mean"),
            std::string::npos);
}

TEST_F(CompareRuns, ARunIsLikeItself) {
  EXPECT_EQ(program_("compare-runs a a").out, "no difference\n");
  ASSERT_EQ(program_("run --timing-only --no-verdict --size 160x128 --out again").code, 0);
  EXPECT_EQ(program_("compare-runs a again").out, "no difference\n");
}

TEST_F(CompareRuns, WhatOnlyOneRunHas) {
  ASSERT_EQ(
      program_("run --timing-only --no-verdict --size 160x128 --set matching.path_storage=memory --out c")
          .code,
      0);
  const json tree = json::parse(program_("compare-runs a c --json").out);
  bool found = false;
  for (const json& difference : tree["results"]) {
    if (difference["name"] != "memory/buffer_row_read/bandwidth") continue;
    found = true;
    EXPECT_TRUE(difference["a"].is_null());
    EXPECT_GT(difference["b"], 0);
  }
  EXPECT_TRUE(found);
}

TEST_F(CompareRuns, RefusesWhatIsNoRun) {
  EXPECT_EQ(error("a nowhere"), "parallax: error: nowhere: no such file or folder\n");
  write("empty/readme.txt", "");
  EXPECT_EQ(error("empty a"),
            "parallax: error: empty: holds no timing.json, so no results of a run that came to its end\n");
  const std::string whole = program_.read("a/timing.json");
  write("cut.json", whole.substr(0, whole.size() / 2));
  EXPECT_EQ(error("cut.json a"), "parallax: error: cut.json: damaged, this is no JSON; run parallax again\n");
  write("other.json", "[1, 2]");
  EXPECT_EQ(error("a other.json"),
            "parallax: error: other.json: no timing.json of parallax, it has no run/version\n");
  json tree = json::parse(whole);
  tree["schema"]["version"]["value"] = 2;
  write("new/timing.json", tree.dump());
  EXPECT_EQ(
      error("new a"),
      "parallax: error: new/timing.json: its schema/version is 2, this parallax reads 1; run it again\n");
  tree.erase("schema");
  write("old/timing.json", tree.dump());
  EXPECT_EQ(
      error("old a"),
      "parallax: error: old/timing.json: has no schema/version, an older parallax wrote it; run it again\n");
  // Who wrote it does not matter.
  tree = json::parse(whole);
  tree["run"]["version"]["value"] = "0.0.1";
  write("other/timing.json", tree.dump());
  EXPECT_EQ(program_("compare-runs a other").out, "no difference\n");
  tree = json::parse(whole);
  tree.erase("stages");
  write("less/timing.json", tree.dump());
  EXPECT_EQ(error("less a"),
            "parallax: error: less/timing.json: damaged, it has no stages; run parallax again\n");
}

}  // namespace compare_runs_test
}  // namespace parallax
