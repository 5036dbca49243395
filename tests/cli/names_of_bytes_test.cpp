// SPDX-License-Identifier: Apache-2.0
// The name of a file is any bytes. What goes into JSON or a page is UTF-8: other bytes are replaced there,
// and nothing is lost for it.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"
#include "tests/paths.hpp"
#include "traces/json_text.hpp"

namespace parallax::test {
namespace names_of_bytes_test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const std::string kName = "caf\xE9";              // Latin-1
const std::string kReplaced = "caf\xEF\xBF\xBD";  // with U+FFFD

TEST(JsonText, WhatIsNoUtf8IsReplaced) {
  EXPECT_EQ(valid_utf8("plain"), "plain");
  EXPECT_EQ(valid_utf8("\xC3\xA9"), "\xC3\xA9") << "what is UTF-8 stays";
  EXPECT_EQ(valid_utf8(kName + ".png"), kReplaced + ".png");
  EXPECT_EQ(json_text(Json{{"a", kName}}), "{\"a\":\"" + kReplaced + "\"}");
  EXPECT_EQ(json_text(Json{{"a", 1}}, 1), "{\n \"a\": 1\n}");
}

class NamesOfBytes : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(program_("scene --rectified --size 64x48 --disparities 32 --frames 2 --out " + kName).code, 0);
  }
  Outcome good(const std::string& arguments) const {
    Outcome outcome = program_(arguments);
    EXPECT_EQ(outcome.code, 0) << arguments << '\n' << outcome.err;
    return outcome;
  }
  Json json(const std::string& name) const { return Json::parse(program_.read(name)); }

  Program program_;
};

TEST_F(NamesOfBytes, InputAndOutputOfARun) {
  const std::string out = "out_" + kName;
  good("run -q -d 32 --report --trace perfetto,vcd,csv,json --input " + kName + " --out " + out);
  const std::string command = json(out + "/timing.json").at("run").at("command").at("value");
  EXPECT_NE(command.find("--input '" + kReplaced + "'"), std::string::npos) << command;
  const std::string page = program_.read(out + "/report.html");
  EXPECT_EQ(valid_utf8(page), page);
  EXPECT_NE(page.find(kReplaced), std::string::npos);
  EXPECT_EQ(good("report " + out).out, "report              " + out + "/report.html\n")
      << "a terminal gets the bytes";
  const std::string printed = good("run --json -d 32 --frames 1 --input " + kName).out;
  EXPECT_EQ(Json::parse(printed).at("input").at("width").at("value"), 64);
  good("compare-runs " + out + " " + out + " --html page_" + kName);
  const std::string comparison = program_.read("page_" + kName);
  EXPECT_EQ(valid_utf8(comparison), comparison);
}

TEST_F(NamesOfBytes, ListsPresetsAndDevices) {
  program_.folder().write("list_" + kName, kName + "/left_00.png " + kName + "/right_00.png\n");
  good("run -q -d 32 --input list_" + kName);
  fs::copy_file(source_path("platform/presets/scenescan-pro.toml"), program_ / (kName + ".toml"));
  good("run -q -d 32 --size 64x48 --preset ./" + kName + ".toml --out preset");
  EXPECT_EQ(json("preset/timing.json").at("configuration").at("preset"), "./" + kReplaced + ".toml");
  EXPECT_EQ(Json::parse(good("config --json --preset ./" + kName + ".toml").out).at("preset"),
            "./" + kReplaced + ".toml");
  fs::copy_file(source_path("platform/presets/memory/ddr3-1066-x32.toml"),
                program_ / ("m" + kName + ".toml"));
  const std::string device = "memory.device=./m" + kName + ".toml";
  good("run -q -d 32 --size 64x48 --timing-only --vary " + device + ",ddr3-1600-x64 --out vary_" + kName);
  EXPECT_EQ(json("vary_" + kName + "/point_0000/timing.json").at("configuration").at("memory").at("device"),
            "./m" + kReplaced + ".toml");
  good("run -q -d 32 --size 64x48 --timing-only --relax --out relax --set " + device);
}

TEST_F(NamesOfBytes, FaultsAreOneLineWithTheBytes) {
  const Outcome outcome = program_("run --left no_" + kName + ".png --right x.png");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err, "parallax: error: image no_" + kName + ".png does not exist\n");
}

}  // namespace names_of_bytes_test
}  // namespace parallax::test
