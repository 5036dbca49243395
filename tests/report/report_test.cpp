// SPDX-License-Identifier: Apache-2.0
// The report of a run: its figures are those of timing.json, and bad input is one line.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "platform/report/report_file.hpp"
#include "platform/results/version.hpp"
#include "tests/cli/program.hpp"
#include "tests/report/hostile_folder.hpp"
#include "tests/traces/naive_number_text.hpp"
#include "tlm/error.hpp"

namespace parallax::test {
namespace report_test {

using Json = nlohmann::ordered_json;

class Report : public ::testing::Test {
 protected:
  void run(const std::string& arguments, int code = 0) {
    const Outcome outcome = program_("run -q --out out " + arguments);
    ASSERT_EQ(outcome.code, code) << outcome.err;
  }
  Json timing() const { return Json::parse(program_.read("out/timing.json")); }
  std::string page() const { return program_.read("out/report.html"); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(program_ / name, std::ios::binary) << text;
  }
  std::string error(const std::string& arguments) {
    const Outcome outcome = program_(arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.out;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    return outcome.err;
  }
  Program program_;
};

// What stands between two texts, for the first time after `after`.
std::string between(const std::string& text, const std::string& after, const std::string& begin,
                    const std::string& end) {
  const std::size_t from = text.find(begin, text.find(after)) + begin.size();
  return text.substr(from, text.find(end, from) - from);
}

// The numbers of the page's row `id`, as they are shown.
std::vector<std::string> cells(const std::string& page, const std::string& id) {
  const std::string row = between(page, "id=\"" + id + "\"", ">", "</tr>");
  std::vector<std::string> found;
  static const std::regex cell("<td>([^<]*)</td>");
  for (std::sregex_iterator it(row.begin(), row.end(), cell), none; it != none; ++it)
    found.push_back((*it)[1]);
  return found;
}

TEST_F(Report, ShowsTheNumbersOfTiming) {
  run("--report --timing-only --size 160x128 -d 64");
  const Json tree = timing();
  const std::string html = page();
  for (const auto& [name, stage] : tree["stages"].items()) {
    const std::vector<std::string> row = cells(html, "stage-" + name);
    ASSERT_GE(row.size(), 9U) << name;
    std::string cycles = row[0];
    cycles.erase(std::remove(cycles.begin(), cycles.end(), ','), cycles.end());
    EXPECT_EQ(std::stod(cycles), stage["cycles_per_frame"]["value"].get<double>()) << name;
    EXPECT_EQ(row[2], naive_number_text(stage["utilisation"]["value"].get<double>(), "%") + " %") << name;
    std::size_t column = row.size() - 6;
    for (const char* share : {"busy", "starved", "blocked", "memory", "synchroniser", "blanking"}) {
      EXPECT_EQ(row[column++],
                fmt::format("{:.1f} %", stage[fmt::format("{}_share", share)]["value"].get<double>()))
          << name;
    }
  }
  // What charts and clicks show is read from here.
  const Json data = Json::parse(between(html, "id=\"data\"", ">", "</script>"));
  EXPECT_EQ(data["stages"], tree["stages"]);
  EXPECT_EQ(data["streams"], tree["streams"]);
  EXPECT_EQ(data["energy"], tree["energy"]);
  EXPECT_EQ(data["texts"]["stages"]["matching"]["utilisation"],
            naive_number_text(tree["stages"]["matching"]["utilisation"]["value"].get<double>(), "%") + " %");
  EXPECT_EQ(data["profile"], Json::parse(program_.read("out/profile.json")));
  EXPECT_EQ(data["relaxations"], Json::parse(program_.read("out/relaxations.json")));
  EXPECT_NE(html.find(tree["limit"]["verdict"]["value"].get<std::string>()), std::string::npos);
  EXPECT_NE(html.find(tree["run"]["command"]["value"].get<std::string>()), std::string::npos);
}

TEST_F(Report, RelaxationsAreThoseThatRelaxFinds) {
  run("--report --timing-only --size 64x48 -d 32");
  ASSERT_EQ(program_("run -q --timing-only --relax --out relaxed --size 64x48 -d 32").code, 0);
  EXPECT_EQ(program_.read("out/relaxations.json"), program_.read("relaxed/relaxations.json"));
}

TEST_F(Report, CanBeMadeLater) {
  run("--report --size 64x48 -d 32");
  const std::string first = page();
  EXPECT_NE(first.find("data:image/png;base64,"), std::string::npos);
  std::filesystem::remove(program_ / "out/report.html");
  const Outcome outcome = program_("report out");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "report              out/report.html\n");
  EXPECT_EQ(page(), first);
}

TEST_F(Report, NeedsNoMoreThanTiming) {
  run("--timing-only --size 64x48 -d 32 --timing-frames 1");
  std::filesystem::remove(program_ / "out/profile.json");
  EXPECT_EQ(program_("report -q out").code, 0);
  EXPECT_EQ(page().find("chart-memory\""), page().find("chart-memory\"", page().find("<script>")));
}

TEST_F(Report, SaysWhetherThePublishedFiguresAreReached) {
  const auto verdict = [&](const std::string& arguments) {
    run("--timing-only --no-verdict " + arguments);
    EXPECT_EQ(program_("report -q out").code, 0);
    const std::string html = page();
    return between(html, "640x480, 128 disparities", "class=\"", "\"");
  };
  EXPECT_EQ(verdict(""), "pass");
  EXPECT_EQ(verdict("--set clocks.core_hz=100e6"), "fail");
  EXPECT_EQ(verdict("--set link.host_pixel_rate=0"), "fail");  // 38 % above
  EXPECT_EQ(verdict("-d 96"), "soft");                         // says nothing
}

TEST_F(Report, OfADeadlockSaysWhoWaits) {
  run("--report --size 96x64 --set streams.left_output.depth=4", 1);
  const Json deadlock = timing()["deadlock"];
  const std::string html = page();
  EXPECT_NE(html.find(deadlock["remedy"]["value"].get<std::string>()), std::string::npos);
  const std::string banner = between(html, "stuck", "<ol>", "</ol>");
  for (const auto& [name, wait] : deadlock.items()) {
    if (name == "remedy") continue;
    EXPECT_NE(banner.find(wait["waiter"]["value"].get<std::string>()), std::string::npos);
  }
  const std::string svg = between(html, "<svg", ">", "</svg>");
  EXPECT_NE(svg.find("<title>left_output: full, depth 4</title>"), std::string::npos);
}

TEST_F(Report, WordsOfTheUserAreNoMarkup) {
  run("--report --timing-only --size 64x48 -d 32");
  Json tree = timing();
  tree["run"]["command"]["value"] = "parallax </script><b>&\"";
  tree["stages"]["census"]["busy"]["description"] = "</script><i>";
  write("out/timing.json", tree.dump());
  ASSERT_EQ(program_("report -q out").code, 0);
  EXPECT_NE(page().find("parallax &lt;/script&gt;&lt;b&gt;&amp;&quot;"), std::string::npos);
  EXPECT_EQ(page().find("</script><b>"), std::string::npos);
  EXPECT_EQ(page().find("</script><i>"), std::string::npos);
}

TEST_F(Report, BadInputIsOneLine) {
  EXPECT_EQ(error("run --report"),
            "parallax: error: --report needs --out: the folder that report.html is written to\n");
  EXPECT_EQ(error("run --timing-only --report --out o --relax"),
            "parallax: error: --report is of one run: it cannot go with --relax\n");
  EXPECT_EQ(error("run --timing-only --report --out o --vary clocks.core_hz=1e8,2e8"),
            "parallax: error: --report is of one run: it cannot go with --vary\n");
  EXPECT_EQ(error("run --report --out o --no-verdict"),
            "parallax: error: --report and --no-verdict exclude each other: it says what each limit costs\n");
  EXPECT_EQ(error("report nowhere"), "parallax: error: nowhere: no such file or folder\n");
  std::filesystem::create_directories(program_ / "out");
  EXPECT_EQ(error("report out"),
            "parallax: error: out: holds no timing.json, so no results of a run that came to its end\n");
  write("out/timing.json", "{");
  EXPECT_EQ(error("report out"),
            "parallax: error: out/timing.json: damaged, this is no JSON; run parallax again\n");
  write(
      "out/timing.json",
      R"({"schema": {"version": {"value": 0, "unit": ""}}, "run": {"version": {"value": "0.0.7", "unit": ""}}})");
  EXPECT_EQ(
      error("report out"),
      "parallax: error: out/timing.json: its schema/version is 0, this parallax reads 1; run it again\n");
  EXPECT_FALSE(std::filesystem::exists(program_ / "out/report.html"));
  std::filesystem::remove(program_ /
                          "out/timing.json");  // which no run has written, so that none replaces it
  run("--timing-only --size 64x48 -d 32");
  EXPECT_EQ(error("report out/timing.json"),
            "parallax: error: out/timing.json is a file, a report is made of a run's folder\n");
  write("out/profile.json", "[1, 2");
  EXPECT_EQ(error("report out"),
            "parallax: error: out/profile.json: damaged, this is no JSON; run parallax again\n");
  EXPECT_FALSE(std::filesystem::exists(program_ / "out/report.html"));
}

TEST_F(Report, AnImageOfOneRow) {
  run("--report --size 1925x1 --set image.max_width=4096 --set tiles.largest_number=4 -d 32");
  EXPECT_NE(page().find("data:image/png"), std::string::npos);
}

TEST_F(Report, ADamagedPictureIsNotLeftOutInSilence) {
  run("--size 64x48 -d 32");
  const std::string picture = program_.read("out/causes.png");
  write("out/causes.png", picture.substr(0, 30));
  EXPECT_EQ(error("report out"),
            "parallax: error: cannot read result out/causes.png: it is damaged, or not a PNG, JPEG, TIFF, "
            "BMP, PNM or "
            "WebP file\n");
  write("out/causes.png", picture);
  write("out/strip.gif", "GIF89a and so on");
  EXPECT_EQ(error("report out"),
            "parallax: error: cannot read result out/strip.gif: it is damaged; run parallax again\n");
  std::filesystem::remove(program_ / "out/strip.gif");
  EXPECT_EQ(program_("report -q out").code, 0);
}

// Every path of a tree.
void gather(const Json& tree, const std::string& path, std::vector<std::string>& paths) {
  if (!path.empty()) paths.push_back(path);
  if (!tree.is_object()) return;
  for (const auto& [name, child] : tree.items()) gather(child, path + "/" + name, paths);
}

// Whatever is missing or of another kind: a report or one line, never a crash.
TEST_F(Report, DamageAnywhereIsAnErrorOfTheUsers) {
  run("--report --timing-only --size 64x48 -d 32 --timing-frames 4");
  const std::vector<Json> others = {nullptr, 7, "x", Json::array({1}), Json::object()};
  std::size_t tried = 0, refused = 0;
  for (const char* name : {"out/timing.json", "out/profile.json", "out/relaxations.json"}) {
    const std::string good = program_.read(name);
    std::vector<std::string> paths;
    gather(Json::parse(good), "", paths);
    const std::size_t step = std::max<std::size_t>(1, paths.size() / 60);
    for (std::size_t i = 0; i < paths.size(); i += step, ++tried) {
      Json tree = Json::parse(good);
      const Json::json_pointer pointer(paths[i]);
      if (i % 6 == 5) {
        tree.at(pointer.parent_pointer()).erase(pointer.back());
      } else {
        tree.at(pointer) = others[i % 6];
      }
      write(name, tree.dump());
      try {
        report_of(program_ / "out");
      } catch (const UserError& error) {
        ++refused;
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      }
    }
    write(name, good);
  }
  EXPECT_GT(tried, 100U);
  EXPECT_GT(refused, 10U);
  EXPECT_LT(refused, tried);
}

// The browser's test sees the same in a browser; this one needs none.
TEST_F(Report, EscapesWhatAFolderHolds) {
  run("--timing-only --report --size 64x48 -d 32");
  make_hostile(program_, "out");
  std::filesystem::remove(program_ / "out/report.html");
  ASSERT_EQ(program_("report -q out").code, 0);
  ASSERT_EQ(program_("compare-runs -q out out --html c.html").code, 0);
  for (const std::string& html : {page(), program_.read("c.html")}) {
    EXPECT_EQ(html.find("<b class=marker"), std::string::npos);
    EXPECT_NE(html.find("b class=marker"), std::string::npos);
    const std::string data = between(html, "id=\"data\"", ">", "</script>");
    EXPECT_EQ(data.find_first_of("<>&"), std::string::npos);
    EXPECT_EQ(data.find("\xE2\x80\xA8"), std::string::npos);
    EXPECT_FALSE(Json::parse(data, nullptr, false).is_discarded());
  }
  const Json data = Json::parse(between(page(), "id=\"data\"", ">", "</script>"));
  const std::string name = "census" + kHostileName;
  EXPECT_EQ(data.at("stages").at(name), timing().at("stages").at(name)) << "the data stay what they were";
}

}  // namespace report_test
}  // namespace parallax::test
