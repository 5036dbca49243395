// SPDX-License-Identifier: Apache-2.0
// The glossary is that of the numbers which runs write: each is in it, with its unit and what it means, and
// nothing else is.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "tests/cli/markdown.hpp"
#include "tests/cli/program.hpp"
#include "tests/paths.hpp"
#include "traces/metrics.hpp"

namespace parallax::test {
namespace glossary_test {

using Json = nlohmann::ordered_json;

struct Entry {
  std::string name;
  std::string unit;
  std::string description;
  bool occurs = false;
};

// What may stand for the angle brackets of a pattern.
std::regex pattern(const std::string& text, const char* anything) {
  static const std::regex special("[.+*?()\\[\\]|^$]"), placeholder("<[a-z]+>");
  return std::regex(std::regex_replace(std::regex_replace(text, special, "\\$&"), placeholder, anything));
}

class Glossary : public ::testing::Test {
 protected:
  void SetUp() override {
    const Outcome outcome = program_("glossary --json");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Json glossary = Json::parse(outcome.out);
    for (const Json& entry : glossary.at("metrics")) {
      entries_.push_back({entry.at("name").get<std::string>(), entry.at("unit").get<std::string>(),
                          entry.at("description").get<std::string>()});
    }
  }

  void check(const std::string& arguments, int code = 0) {
    const Outcome outcome = program_(arguments);
    ASSERT_EQ(outcome.code, code) << outcome.err;
    Json tree = Json::parse(outcome.out);
    tree.erase("configuration");
    check(metrics_of(tree), "");
  }

  std::vector<Entry> entries_;
  Program program_;

 private:
  void check(const MetricGroup& group, const std::string& path) {
    for (const Metric& metric : group.metrics) check(metric, path + metric.name);
    for (const MetricGroup& child : group.groups) check(child, path + child.name + "/");
  }

  void check(const Metric& metric, const std::string& path) {
    for (Entry& entry : entries_) {
      if (!std::regex_match(path, pattern(entry.name, "[a-z0-9_]+"))) continue;
      if (entry.name.find('<') != std::string::npos && exact(path)) continue;
      entry.occurs = true;
      EXPECT_EQ(metric.unit, entry.unit) << path;
      EXPECT_TRUE(std::regex_match(metric.description, pattern(entry.description, ".+")))
          << path << ": " << metric.description;
      return;
    }
    ADD_FAILURE() << "the glossary lacks " << path;
  }

  bool exact(const std::string& path) const {
    for (const Entry& entry : entries_) {
      if (entry.name == path) return true;
    }
    return false;
  }
};

TEST_F(Glossary, NamesEveryNumberAndNoOther) {
  check("run --size 320x240 -d 64 --json");
  check("run --size 96x64 --set streams.left_output.depth=4 --json", 1);
  check("run --timing-only --size 96x64 -d 32 --set matching.paths=w,nw,n,ne,e,sw,s,se --json");
  check(
      "run --timing-only --size 96x64 -d 32 --set camera.frame_rate=60 --set camera.fault=missing_row "
      "--set camera.fault_every=3 --json");
  check("run --timing-only --rectified --size 96x64 --preset core-alone --json");
  check(
      "run --timing-only --no-verdict --size 64x48 --set link.host_pixel_rate=1e6 --set "
      "camera.frame_rate=326 "
      "--json");
  check(
      "run --timing-only --no-verdict --size 320x240 --timing-frames 11 --set link.host_pixel_rate=0 --set "
      "link.line_rate=10e9 --set clocks.camera_hz=39e6 --json");
  const std::string alone =
      "run --timing-only --preset core-alone --rectified --size 64x48 --set matching.iterations=1 --json ";
  check(alone + "--no-verdict --set camera.frame_rate=60000 --set camera.frame_buffers=1");
  check(alone + "--set streams.left_texture.depth=64");
  check(alone + "--set streams.left_texture.depth=20 --set pipeline.pixels_per_token=2");
  program_.folder().write("trace.csv", "time_ns,rw,addr,bytes\n0,R,0x0,64\n0,W,0x8000,64\n");
  check("memory trace.csv --config ddr3-1066-x32 --json");
  check("estimate --json");
  for (const Entry& entry : entries_) EXPECT_TRUE(entry.occurs) << "no run writes " << entry.name;
}

TEST_F(Glossary, IsWrittenInSentences) {
  for (const Entry& entry : entries_) {
    EXPECT_GT(entry.description.size(), 10U) << entry.name;
    EXPECT_EQ(entry.description.back(), '.') << entry.name;
  }
}

TEST_F(Glossary, TheCheckedInPageIsWhatItPrints) {
  const Outcome outcome = program_("glossary --markdown");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(read_text(source_path("platform/doc/glossary.md")), outcome.out)
      << "run: parallax glossary --markdown > platform/doc/glossary.md";
}

TEST_F(Glossary, IsTextForAPerson) {
  const std::string text = program_("glossary").out;
  EXPECT_NE(text.find("performance/frame_rate, frames/s; over the steady state\n    Rate at which"),
            std::string::npos)
      << text.substr(0, 2000);
  EXPECT_EQ(program_("glossary --markdown --json").code, 2);
}

}  // namespace glossary_test
}  // namespace parallax::test
