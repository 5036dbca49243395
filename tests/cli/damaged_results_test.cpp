// SPDX-License-Identifier: Apache-2.0
// Results that are read back, damaged: one line with the file's name and the key, from each command that
// reads them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace parallax {
namespace damaged_results_test {

using Json = nlohmann::ordered_json;

class DamagedResults : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(program_("run -q --timing-only --report --out out --size 64x48 -d 32").code, 0);
    ASSERT_EQ(program_("run -q --timing-only --no-verdict --out whole --size 64x48 -d 32").code, 0);
  }

  // What each command says of the folder "out".
  std::vector<std::string> errors() const {
    std::vector<std::string> lines;
    for (const char* command : {"report out", "compare-runs out whole", "compare-runs whole out",
                                "compare-runs whole out --html page.html"}) {
      const test::Outcome outcome = program_(command);
      EXPECT_EQ(outcome.code, 2) << command << outcome.err;
      EXPECT_EQ(test::lines(outcome.err).size(), 1U) << outcome.err;
      EXPECT_LT(outcome.err.size(), 1000U) << "quotes no more than is read";
      lines.push_back(outcome.err);
    }
    return lines;
  }
  Json timing() const { return Json::parse(program_.read("whole/timing.json")); }
  void write(const std::string& text) const { program_.folder().write("out/timing.json", text); }

  test::Program program_;
};

TEST_F(DamagedResults, ATextInTheNumbersPlace) {
  for (const char* path :
       {"/stages/census/utilisation", "/performance/frame_rate", "/streams/left_output/depth", "/input/width",
        "/memory/left/bandwidth", "/latency/exposure_to_host_mean"}) {
    Json tree = timing();
    tree[Json::json_pointer(path)]["value"] = "fast";
    write(tree.dump());
    for (const std::string& line : errors()) {
      EXPECT_NE(line.find("out/timing.json: damaged, "), std::string::npos) << path << line;
      EXPECT_NE(line.find(std::string(path).substr(1)), std::string::npos) << line;
    }
  }
}

TEST_F(DamagedResults, NestedTooDeepCutOrNothingAtAll) {
  const std::string whole = timing().dump();
  const std::string deep(100'000, '[');
  for (const std::string& text : {deep, whole.substr(0, whole.size() / 2), std::string(),
                                  std::string("\0\xFF", 2), "{\"run\":" + std::string(100'000, '{')}) {
    write(text);
    for (const std::string& line : errors())
      EXPECT_NE(line.find("out/timing.json"), std::string::npos) << line;
  }
  write(whole);
  program_.folder().write("out/profile.json", "{\"latency\": " + deep);
  const test::Outcome outcome = program_("report out");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(
      outcome.err,
      "parallax: error: out/profile.json: damaged, it is nested more than 32 deep; run parallax again\n");
}

TEST_F(DamagedResults, AFileWithoutEnd) {
  const test::Outcome outcome = program_("compare-runs /dev/zero out");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err, "parallax: error: /dev/zero is a device, expected results of a run\n");
}

}  // namespace damaged_results_test
}  // namespace parallax
