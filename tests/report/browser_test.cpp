// SPDX-License-Identifier: Apache-2.0
// The pages in headless Chromium: browser.py opens them, clicks, types, and says what it saw.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/program.hpp"
#include "tests/paths.hpp"
#include "tests/report/hostile_folder.hpp"

namespace parallax::test {
namespace browser_test {

using Json = nlohmann::json;

bool has_browser() {
  return std::filesystem::exists("/usr/bin/chromedriver") &&
         std::system("/usr/bin/python3 -c 'import selenium' 2>/dev/null") == 0;
}

// What the browser saw of one page.
Json open(const std::filesystem::path& page, const std::string& options = "") {
  const std::string command =
      "/usr/bin/python3 " + source_path("tests/report/browser.py") + " " + options + " " + page.string();
  std::FILE* const pipe = popen(command.c_str(), "r");
  std::string text;
  std::array<char, 65536> buffer;
  for (std::size_t n; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) text.append(buffer.data(), n);
  EXPECT_EQ(pclose(pipe), 0) << command;
  const Json seen = Json::parse(text, nullptr, false);
  return seen.is_discarded() ? Json::object() : seen.at(0);
}

class Browser : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_browser()) GTEST_SKIP() << "chromium-driver or python3-selenium is not installed";
  }

  void expect_sound(const Json& seen, std::size_t charts) {
    EXPECT_EQ(seen.at("console"), Json::array()) << "errors";
    EXPECT_EQ(seen.at("requests").size(), 1U) << seen.at("requests") << ": the page itself and nothing else";
    EXPECT_EQ(seen.at("sticks_out"), Json::array()) << "wider than a narrow window";
    EXPECT_GT(seen.at("print_bytes"), 10'000);
    for (const char* when : {"canvases", "canvases_in_other_theme", "canvases_after_choice"}) {
      if (!seen.contains(when)) continue;
      EXPECT_EQ(seen.at(when).size(), charts) << when;
      for (const Json& canvas : seen.at(when)) EXPECT_TRUE(canvas.at("drawn").get<bool>()) << canvas << when;
    }
  }

  // A click on a stage, and the keys, show its numbers.
  void expect_details(const Json& seen, const Json& timing) {
    EXPECT_EQ(seen.at("stages").size(), timing.at("stages").size());
    for (const char* how : {"click", "keys"}) {
      const std::string stage = seen.at(how).at("stage");
      const std::string details = seen.at(how).at("details");
      EXPECT_EQ(details.rfind(stage + "\n", 0), 0U) << details;
      std::string cycles =
          details.substr(details.find("cycles per frame\n") + std::string("cycles per frame\n").size());
      cycles = cycles.substr(0, cycles.find(' '));
      cycles.erase(std::remove(cycles.begin(), cycles.end(), ','), cycles.end());
      EXPECT_EQ(std::stod(cycles), timing["stages"][stage]["cycles_per_frame"]["value"].get<double>());
    }
    EXPECT_NE(seen.at("themes")[0], seen.at("themes")[1]);
  }

  Json timing(const std::string& folder) const { return Json::parse(program_.read(folder + "/timing.json")); }

  Program program_;
};

TEST_F(Browser, OpensTheReportOfARun) {
  ASSERT_EQ(program_("run -q --report --out out --size 160x128").code, 0);
  const Json seen = open(program_ / "out/report.html");
  expect_sound(seen, 7);
  expect_details(seen, timing("out"));
  ASSERT_GE(seen.at("images").size(), 3U);
  for (const Json& image : seen.at("images")) EXPECT_EQ(image.at("width"), 160) << image;
}

TEST_F(Browser, OpensThatOfTheLargestImage) {
  // Without what taking limits away gains: a dozen runs of this size.
  ASSERT_EQ(program_("run -q --timing-only --no-verdict --timing-frames 2 --out out --size 1856x1856 --set "
                     "matching.iterations=1")
                .code,
            0);
  ASSERT_EQ(program_("report -q out").code, 0);
  const Json seen = open(program_ / "out/report.html");
  expect_sound(seen, 6);
  expect_details(seen, timing("out"));
}

TEST_F(Browser, OpensThatOfADeadlock) {
  ASSERT_EQ(program_("run -q --report --out out --size 96x64 --set streams.left_output.depth=4").code, 1);
  const Json seen = open(program_ / "out/report.html");
  expect_sound(seen, 2);
  EXPECT_NE(seen.at("text").get<std::string>().find("The machine got stuck"), std::string::npos);
  EXPECT_NE(seen.at("text").get<std::string>().find("streams.left_output.depth = 1959 would free it (now 4)"),
            std::string::npos);
}

// What a page shows of a folder is text, whatever its names and texts are.
TEST_F(Browser, MakesNoElementOfAHostileFolder) {
  ASSERT_EQ(program_("run -q --timing-only --report --out out --size 64x48 -d 32").code, 0);
  make_hostile(program_, "out");
  std::filesystem::remove(program_ / "out/report.html");
  ASSERT_EQ(program_("report -q out").code, 0);
  ASSERT_EQ(program_("compare-runs -q out out --html out/c.html").code, 0);
  for (const char* name : {"out/report.html", "out/c.html"}) {
    for (const char* options : {"", "--no-script"}) {
      const Json seen = open(program_ / name, options);
      EXPECT_EQ(seen.at("markers"), 0) << name;
      EXPECT_EQ(seen.at("console"), Json::array()) << name;
      EXPECT_NE(seen.at("text").get<std::string>().find("class=marker"), std::string::npos)
          << "shown as text";
    }
  }
  const Json seen = open(program_ / "out/report.html");
  for (const Json& canvas : seen.at("canvases_after_choice"))
    EXPECT_TRUE(canvas.at("drawn").get<bool>()) << canvas;
}

TEST_F(Browser, ReadsWithoutAScript) {
  ASSERT_EQ(program_("run -q --report --timing-only --out out --size 64x48 -d 32").code, 0);
  const Json seen = open(program_ / "out/report.html", "--no-script");
  EXPECT_EQ(seen.at("console"), Json::array());
  const std::string text = seen.at("text");
  const Json tree = timing("out");
  EXPECT_NE(text.find(tree["limit"]["verdict"]["value"].get<std::string>()), std::string::npos);
  for (const auto& stage : tree["stages"].items())
    EXPECT_NE(text.find("\n" + stage.key() + " "), std::string::npos);
  EXPECT_EQ(text.find("dark or light"), std::string::npos);
  EXPECT_EQ(text.find("Choose a stage"), std::string::npos);
}

TEST_F(Browser, OpensAComparison) {
  ASSERT_EQ(program_("run -q --timing-only --out a --size 64x48 -d 32").code, 0);
  ASSERT_EQ(program_("run -q --timing-only --out b --size 64x48 -d 32 --set clocks.core_hz=100e6").code, 0);
  ASSERT_EQ(program_("compare-runs -q a b --html c.html").code, 0);
  const Json seen = open(program_ / "c.html");
  expect_sound(seen, 1);
  const std::string text = seen.at("text");
  EXPECT_NE(text.find("clocks/core_hz"), std::string::npos);
  EXPECT_NE(text.find("performance/frame_rate"), std::string::npos);
}

}  // namespace browser_test
}  // namespace parallax::test
