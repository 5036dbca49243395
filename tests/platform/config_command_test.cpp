// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <stdlib.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "platform/commands/cli.hpp"
#include "tests/paths.hpp"
#include "tests/platform/temporary_folder.hpp"

namespace parallax {
namespace config_command_test {

struct Outcome {
  int code;
  std::string out;
  std::string err;
};

class ConfigCommand : public ::testing::Test {
 protected:
  ConfigCommand() { ::setenv("PARALLAX_PRESET_PATH", test::source_path("platform/presets").c_str(), 1); }

  static Outcome run(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "parallax");
    std::ostringstream out, err;
    const int code = run_command_line(static_cast<int>(arguments.size()), arguments.data(), out, err);
    return {code, out.str(), err.str()};
  }
  /// A bad line must end with exit code 2, nothing on standard output and this one line on standard error.
  static void expect_error(const std::vector<const char*>& arguments, const std::string& line) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "parallax: error: " + line + "\n");
  }
};

/// The text without its first line, the description.
std::string body(const std::string& text) { return text.substr(text.find('\n')); }

TEST_F(ConfigCommand, PrintsAPresetThatReadsBack) {
  TemporaryFolder folder;
  const Outcome first = run({"config", "--set", "matching.p1=11", "-s", "camera.frame_rate=29.97", "-d",
                             "256", "--set=matching.paths=w,n"});
  EXPECT_EQ(first.code, 0);
  EXPECT_EQ(first.err, "");
  EXPECT_NE(first.out.find("\np1 = 11 "), std::string::npos);
  EXPECT_NE(first.out.find("\nframe_rate = 29.97 "), std::string::npos);
  EXPECT_NE(first.out.find("# frames/s\n"), std::string::npos);
  const std::string path = folder.write("again.toml", first.out);
  EXPECT_EQ(body(run({"config", "--preset", path.c_str()}).out), body(first.out));
}

TEST_F(ConfigCommand, DocumentationReadsBackWithTagsAndSources) {
  TemporaryFolder folder;
  const Outcome first = run({"config", "--docs", "--set", "matching.p1=11"});
  EXPECT_NE(first.out.find("# Allowed: an integer from 0 to 255, unit: units.\n"
                           "p1 = { value = 11, tag = \"C\", source = \"command line\" }\n"),
            std::string::npos);
  EXPECT_NE(first.out.find("May change from frame to\n"
                           "# frame: register stereo.algorithm_parameters_1, field p1.\n"),
            std::string::npos)
      << first.out;
  const std::string path = folder.write("again.toml", first.out);
  EXPECT_EQ(body(run({"config", "--docs", "--preset", path.c_str()}).out), body(first.out));
}

TEST_F(ConfigCommand, PrintsJson) {
  const auto plain = nlohmann::json::parse(run({"config", "--json"}).out);
  EXPECT_EQ(plain["preset"], "scenescan-pro");
  EXPECT_EQ(plain["matching"]["p1"], 8);
  EXPECT_EQ(plain["dma"]["left"]["burst_bytes"], 128);
  EXPECT_EQ(plain["link"]["enabled"], true);
  const auto documented = nlohmann::json::parse(run({"config", "--json", "--docs"}).out);
  const auto& p1 = documented["matching"]["p1"];
  EXPECT_EQ(p1["value"], 8);
  EXPECT_EQ(p1["unit"], "units");
  EXPECT_EQ(p1["allowed"], "an integer from 0 to 255");
  EXPECT_EQ(p1["tag"], "S");
  EXPECT_FALSE(p1["documentation"].get<std::string>().empty());
}

TEST_F(ConfigCommand, ListsPresets) {
  TemporaryFolder folder;
  folder.write("b.toml", "description = \"the second\"\n");
  folder.write("first.toml", "description = \"the first\"\n");
  ::setenv("PARALLAX_PRESET_PATH", folder.path().c_str(), 1);
  // Names in a column as wide as the longest, which may be one of the shipped presets.
  const std::regex list("b +the second\n(.|\n)*first +the first\n(.|\n)*");
  EXPECT_TRUE(std::regex_match(run({"config", "--list"}).out, list));
  EXPECT_EQ(nlohmann::json::parse(run({"config", "--list", "--json"}).out)["b"], "the second");
}

TEST_F(ConfigCommand, RefusesBadLines) {
  expect_error({}, "no command given; parallax --help lists them");
  expect_error({"confg"}, "unknown command confg; the nearest is config");
  expect_error({"config", "--presett=x"}, "unknown option --presett; the nearest is --preset");
  expect_error({"--versoin"}, "unknown option --versoin; the nearest is --version");
  expect_error({"config", "extra"}, "unexpected argument 'extra'");
  expect_error({"config", "--set", "a=1", "b=1"}, "unexpected argument 'b=1'");
  expect_error({"config", "-q", "-v"}, "--quiet excludes --verbose");
  expect_error({"config", "--disparities", "many"}, "Could not convert: --disparities = many");
}

TEST_F(ConfigCommand, RefusesBadConfigurations) {
  expect_error({"config", "--set", "matching.p1=9", "--set", "mathcing.p1=3"},
               "--set mathcing.p1=3: unknown key mathcing.p1; the nearest is matching.p1");
  expect_error({"config", "-p", "./none.toml"}, "preset file ./none.toml does not exist");
}

TEST_F(ConfigCommand, HelpAndVersionAreNoErrors) {
  EXPECT_EQ(run({"--version"}).code, 0);
  EXPECT_EQ(run({"--version"}).out.rfind("parallax 0", 0), 0U);
  EXPECT_NE(run({"config", "--help"}).out.find("--docs"), std::string::npos);
  EXPECT_EQ(run({"config", "--help"}).code, 0);
}

/// The program itself: nothing but our line on standard error, not even SystemC's notice.
TEST_F(ConfigCommand, TheProgramPrintsOneLineAndExitsWithTwo) {
  TemporaryFolder folder;
  const std::string command =
      test::program_path() + " config --set matching.p1=900 >" + (folder / "out") + " 2>" + (folder / "err");
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_EQ(folder.read("out"), "");
  EXPECT_EQ(folder.read("err"),
            "parallax: error: --set matching.p1=900: matching.p1 = 900: must be an integer from 0 to 255\n");
}

TEST_F(ConfigCommand, TheProgramReportsAFullDiskBehindStandardOutput) {
  TemporaryFolder folder;
  const std::string command = test::program_path() + " config >/dev/full 2>" + (folder / "err");
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_EQ(folder.read("err"), "parallax: error: cannot write to standard output\n");
}

}  // namespace config_command_test
}  // namespace parallax
