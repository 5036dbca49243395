// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "platform/validation/published_row.hpp"
#include "tests/cli/program.hpp"
#include "tests/platform/error_of.hpp"
#include "tests/platform/temporary_folder.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace validate_command_test {

class ValidateCommand : public testing::Test {
 protected:
  std::string write(const std::string& text, const std::string& name = "rows.toml") {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  // A row with these lines in place of what it has.
  static std::string row(const std::string& lines) { return "[[row]]\n" + lines + "\n"; }
  std::string complaint(const std::string& text) {
    const std::string path = write(text);
    const std::string line = error_of([&] { read_published_rows(path, {}); });
    return line.rfind(path, 0) == 0 ? line.substr(path.size()) : line;
  }

  const TemporaryFolder folder_;
  test::Program program_;
};

const std::string kSmall = R"(name = "small"
source = "a test"
size = "64x48"
set = ["matching.iterations=1", "link.host_pixel_rate=1e6"]
metric = "performance/frame_rate"
unit = "frames/s"
)";

TEST_F(ValidateCommand, TheTableOfThePaperAndOtherDesigns) {
  const test::Outcome outcome = program_("validate --json");
  EXPECT_EQ(outcome.code, 0) << outcome.err << outcome.out;
  const auto tree = nlohmann::json::parse(outcome.out);
  EXPECT_TRUE(tree["within"]);
  ASSERT_EQ(tree["rows"].size(), 17u);
  for (int i = 0; i < 8; ++i) {
    const auto& entry = tree["rows"][static_cast<std::size_t>(i)];
    EXPECT_GE(entry["deviation_percent"], 0) << entry;
    EXPECT_LE(entry["deviation_percent"], 7) << entry;
    EXPECT_EQ(entry["preset"], "scenescan-pro");
    EXPECT_EQ(entry["set"].size(), 1u) << "one parameter set for all rows";
  }
  // 8 W in every configuration: what the estimate lacks is not in what moves.
  std::vector<double> watts;
  for (const auto& entry : tree["rows"]) {
    if (entry.value("metric", "") == "energy/power_total") watts.push_back(entry["predicted"]);
  }
  ASSERT_EQ(watts.size(), 2u);
  EXPECT_NEAR(watts[1] / watts[0], 1, 0.03);
}

TEST_F(ValidateCommand, TheRivalHypothesisGivesTheSameTable) {
  const test::Outcome outcome =
      program_("validate --rows scenescan-pro --preset scenescan-pro-fixed-margins");
  EXPECT_EQ(outcome.code, 0) << outcome.err << outcome.out;
}

TEST_F(ValidateCommand, OneOutsideItsToleranceEndsWith1) {
  // 1 Mpx/s are 325.5 frames of 3072 pixels.
  const std::string within =
      write("[[row]]\n" + kSmall + "published = 325\nleast = 0\nmost = 1\n", "within.toml");
  const test::Outcome good = program_("validate --rows " + within);
  EXPECT_EQ(good.code, 0) << good.err << good.out;
  EXPECT_NE(good.out.find("ok   host"), std::string::npos) << good.out;
  const std::string outside =
      write("[[row]]\n" + kSmall + "published = 300\nleast = 0\nmost = 1\n", "outside.toml");
  const test::Outcome bad = program_("validate --rows " + outside + " --out " + (folder_ / "out"));
  EXPECT_EQ(bad.code, 1);
  EXPECT_NE(bad.out.find("OUT  host"), std::string::npos) << bad.out;
  const auto tree = nlohmann::json::parse(folder_.read("out/validation.json"));
  EXPECT_FALSE(tree["within"]);
  EXPECT_NEAR(tree["rows"][0]["deviation_percent"], 8.5, 0.1);
}

TEST_F(ValidateCommand, SetChangesTheMachineButNotTheOperatingPoint) {
  const std::string rows = write("[[row]]\n" + kSmall + "published = 325\nleast = 0\nmost = 1\n");
  EXPECT_EQ(program_("validate --rows " + rows + " --set link.host_pixel_rate=2e6").code, 0);
  EXPECT_EQ(program_("validate --rows " + rows + " --set link.line_rate=1e6").code, 1);
}

TEST_F(ValidateCommand, SensitivityToWhatIsFitted) {
  // Limited by the host, and so proportional to its rate alone.
  std::string row = kSmall;
  row.replace(row.find(", \"link.host_pixel_rate=1e6\""), 28, "");
  const std::string machine = write(
      "description = \"\"\ninherits = \"scenescan-pro\"\n[link]\n"
      "host_pixel_rate = { value = 1_000_000, tag = \"F\", source = \"a test\" }\n",
      "machine.toml");
  const std::string rows =
      write("preset = \"" + machine + "\"\n[[row]]\n" + row + "published = 325\nleast = 0\nmost = 1\n");
  const test::Outcome outcome = program_("validate --sensitivity --json --rows " + rows);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const auto tree = nlohmann::json::parse(outcome.out)["sensitivity"];
  ASSERT_EQ(tree.size(), 3u);
  for (const auto& entry : tree) {
    const bool host = entry["key"] == "link.host_pixel_rate";
    EXPECT_NEAR(entry["rows"][0]["lower_percent"], host ? -10 : 0, 0.01) << entry;
    EXPECT_NEAR(entry["rows"][0]["higher_percent"], host ? 10 : 0, 0.01) << entry;
  }
  const test::Outcome text = program_("validate --sensitivity --rows " + rows);
  EXPECT_NE(text.out.find("    -10.0 %    +10.0 %"), std::string::npos) << text.out;
}

TEST_F(ValidateCommand, WhatAnotherPresetHasNotFittedDoesNotMoveItsRows) {
  std::string row = kSmall;
  row.replace(row.find(", \"link.host_pixel_rate=1e6\""), 28, "");
  const std::string head = "description = \"\"\ninherits = \"scenescan-pro\"\n[link]\n";
  const std::string fitted = write(
      head + "host_pixel_rate = { value = 1_000_000, tag = \"F\", source = \"a test\" }\n", "fitted.toml");
  const std::string stated = write(
      head + "host_pixel_rate = { value = 1_000_000, tag = \"S\", source = \"a test\" }\n", "stated.toml");
  const std::string rest = "published = 325\nleast = 0\nmost = 1\n";
  const std::string rows = write("preset = \"" + fitted + "\"\n[[row]]\n" + row + rest +
                                 "[[row]]\npreset = \"" + stated + "\"\n" + row + rest);
  const test::Outcome outcome = program_("validate --sensitivity --json --rows " + rows);
  const auto tree = nlohmann::json::parse(outcome.out, nullptr, false)["sensitivity"];
  ASSERT_EQ(tree.size(), 3u) << outcome.err;
  for (const auto& entry : tree) {
    const bool host = entry["key"] == "link.host_pixel_rate";
    EXPECT_NEAR(entry["rows"][0]["higher_percent"], host ? 10 : 0, 0.01) << entry;
    EXPECT_NEAR(entry["rows"][1]["higher_percent"], 0, 0.01) << entry;
  }
}

TEST_F(ValidateCommand, WhatMustBeRefusedAndIsNot) {
  const std::string rows =
      write(row("name = \"fits\"\nsource = \"a test\"\nsize = \"64x48\"\nrefused = true"));
  const test::Outcome outcome = program_("validate --rows " + rows);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.out.find("not refused"), std::string::npos) << outcome.out;
}

TEST_F(ValidateCommand, AMachineThatGetsStuckIsOutside) {
  const std::string rows = write("[[row]]\n" + kSmall + "published = 325\nleast = 0\nmost = 1\n");
  const test::Outcome outcome = program_("validate --rows " + rows + " --set streams.left_texture.depth=8");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.out.find("stuck: "), std::string::npos) << outcome.out;
}

TEST_F(ValidateCommand, WhatIsNoRow) {
  EXPECT_EQ(complaint("description = \"none\"\n"), ": holds no [[row]]");
  EXPECT_EQ(complaint("[rows]\n"), ":1: unknown entry 'rows'; there may be description, preset and [[row]]");
  EXPECT_EQ(complaint(row(kSmall + "publshed = 3")), ":8: a row has no 'publshed'; the nearest is published");
  EXPECT_EQ(complaint(row("name = 3")), ":2: name must be text");
  EXPECT_EQ(complaint(row("name = \"a\"")), ":1: source must be text, where it was published");
  EXPECT_EQ(complaint(row("name = \"a\"\nsource = \"b\"\nsize = \"640\"")),
            ":4: size must be a size such as \"640x480\"");
  EXPECT_EQ(complaint(row(kSmall + "published = 0")), ":8: published must be a number above 0");
  EXPECT_EQ(complaint(row(kSmall + "published = 3\nleast = 2\nmost = 1")),
            ":10: most must be at least 2, as `least` is");
  EXPECT_EQ(complaint(row("name = \"a\"\nsource = \"b\"\nsize = \"6x4\"\nset = \"a=b\"")),
            ":5: set must be a list of texts such as \"matching.iterations=8\"");
  EXPECT_EQ(complaint(row("name = \"a\"\nsource = \"b\"\nsize = \"6x4\"\nset = [3]")),
            ":5: set must be a list of texts such as \"matching.iterations=8\"");
}

TEST_F(ValidateCommand, WhatCannotBeRun) {
  const auto error = [&](const std::string& lines, const std::string& options = "") {
    const test::Outcome outcome = program_("validate --rows " + write("[[row]]\n" + lines) + " " + options);
    EXPECT_EQ(outcome.code, 2);
    return outcome.err;
  };
  const std::string tail = "published = 325\nleast = 0\nmost = 1\n";
  std::string other = kSmall;
  other.replace(other.find("performance/frame_rate"), 22, "performance/fps");
  const auto row_error = [&](const std::string& lines, const std::string& options = "") {
    const std::string text = error(lines, options);
    const std::size_t begin = text.find("rows.toml:1: ");
    return begin == std::string::npos ? text : text.substr(begin);
  };
  EXPECT_EQ(
      row_error(other + tail),
      "rows.toml:1: small: timing.json has no number 'performance/fps', such as performance/frame_rate; or "
      "frame_time\n");
  std::string unit = kSmall;
  unit.replace(unit.find("frames/s"), 8, "km");
  EXPECT_EQ(row_error(unit + tail),
            "rows.toml:1: small: unit is 'km', but performance/frame_rate is in frames/s\n");
  EXPECT_NE(error(std::string(kSmall) + "published = inf\nleast = 0\nmost = 1\n")
                .find("published must be a number"),
            std::string::npos);
  std::string key = kSmall;
  key.replace(key.find("matching.iterations"), 19, "matching.iteration");
  EXPECT_EQ(row_error(key + tail).rfind("rows.toml:1: small: --set matching.iteration=1: unknown key", 0),
            0u);
  EXPECT_NE(error(kSmall + tail, "--set matching.p3=1").find("matching.p3"), std::string::npos);
  std::string wide = kSmall;
  wide.replace(wide.find("64x48"), 5, "2048x48");
  EXPECT_EQ(
      row_error(wide + tail),
      "rows.toml:1: small: images of 2048 columns do not fit: 2 tiles of 1024 columns (tiles.largest_number, "
      "tiles.limit) that overlap by 32 + 32 + disparity offset 0 + range 32 hold 1952\n");
  EXPECT_EQ(row_error(wide + tail, "--set image.max_width=1856"),
            "rows.toml:1: small: image.max_width = 1856 is less than the row's 2048 px\n");
  std::string high = kSmall;
  high.replace(high.find("64x48"), 5, "64x1888");
  EXPECT_EQ(row_error(high + tail),
            "rows.toml:1: small: image.max_height = 1856 is less than the row's 1888 px\n");
  const test::Outcome none = program_("validate --rows scenescan-pr");
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.err.find("no rows 'scenescan-pr'"), std::string::npos) << none.err;
}

}  // namespace validate_command_test
}  // namespace parallax
