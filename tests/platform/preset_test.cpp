// SPDX-License-Identifier: Apache-2.0
#include "platform/config/preset.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "platform/config/preset_file.hpp"
#include "tests/platform/error_of.hpp"
#include "tests/platform/temporary_folder.hpp"
#include "tests/platform/unprivileged.hpp"

namespace parallax {
namespace preset_test {

class PresetTest : public ::testing::Test {
 protected:
  std::string error(const std::string& name) {
    return error_of([&] { load_preset(name, {folder_.path()}); });
  }
  /// The error of a preset with this content, without the file's path.
  std::string error_in(const std::string& content) {
    const std::string path = folder_.write("bad.toml", content);
    const std::string line = error("bad");
    return line.rfind(path, 0) == 0 ? line.substr(path.size()) : line;
  }
  std::int64_t integer(const RawConfig& values, const std::string& key) {
    return std::get<std::int64_t>(std::get<ConfigValue>(values.at(key).value));
  }

  TemporaryFolder folder_;
};

TEST_F(PresetTest, ReadsBareAndAnnotatedValues) {
  const std::string path = folder_.write("a.toml",
                                         "description = \"A machine\"\n"
                                         "[matching]\n"
                                         "p1 = 1_0\n"
                                         "p2 = { value = 42, tag = \"S\", source = \"paper\" }\n"
                                         "[dma]\n"
                                         "left.burst_bytes = 64\n"
                                         "[dma.map]\n"
                                         "burst_bytes = 32\n"
                                         "[link.line_rate]\n"
                                         "value = 5\n");
  const PresetFile preset = read_preset_file(path);
  EXPECT_EQ(preset.description, "A machine");
  EXPECT_FALSE(preset.inherits);
  EXPECT_EQ(preset.values.size(), 5U);
  EXPECT_EQ(integer(preset.values, "matching.p1"), 10);
  EXPECT_EQ(preset.values.at("matching.p1").origin, path + ":3");
  EXPECT_FALSE(preset.values.at("matching.p1").tag);
  EXPECT_EQ(integer(preset.values, "matching.p2"), 42);
  EXPECT_EQ(preset.values.at("matching.p2").tag, Tag::kStated);
  EXPECT_EQ(preset.values.at("matching.p2").source, "paper");
  EXPECT_EQ(integer(preset.values, "dma.left.burst_bytes"), 64);
  EXPECT_EQ(integer(preset.values, "dma.map.burst_bytes"), 32);
  EXPECT_EQ(integer(preset.values, "link.line_rate"), 5);
}

TEST_F(PresetTest, SaysWhatIsWrongInAFile) {
  EXPECT_EQ(error_in("[matching]\np1 = = 3\n").rfind(":2: ", 0), 0U);
  EXPECT_EQ(error_in("[matching]\np1 = 3\np1 = 4\n").rfind(":3: ", 0), 0U) << "a key given twice";
  EXPECT_NE(error_in("[matching]\np1 = 3\np1 = 4\n").find("p1"), std::string::npos);
  EXPECT_EQ(
      error_in("[matching]\n\np1 = { value = 3, tag = \"X\" }\n"),
      ":3: the tag of matching.p1 must be \"S\" (stated), \"D\" (derived), \"I\" (inferred), \"F\" (fitted) "
      "or \"C\" (own choice)");
  EXPECT_EQ(error_in("p1 = { value = 3, source = 4 }\n"), ":1: the source of p1 must be text");
  EXPECT_EQ(error_in("p1 = { value = 3, note = 4 }\n"),
            ":1: p1 has an unknown part 'note'; it may have value, tag and source");
  EXPECT_EQ(error_in("description = 3\n"), ":1: description must be text");
  EXPECT_EQ(error_in("\ninherits = true\n"), ":2: inherits must be text");
}

TEST_F(PresetTest, EveryErrorIsOneLine) {
  EXPECT_EQ(error_in("a = \"\"\"\nx\n").find('\n'), std::string::npos);
}

TEST_F(PresetTest, NamesWhatNoKeyCanHold) {
  const PresetFile preset = read_preset_file(folder_.write("a.toml", "a = [1]\nb = 1979-05-27\n[c]\n"));
  EXPECT_EQ(std::get<NotAValue>(preset.values.at("a").value).description, "an array");
  EXPECT_EQ(std::get<NotAValue>(preset.values.at("b").value).description, "a date or time");
  EXPECT_TRUE(std::get<NotAValue>(preset.values.at("c").value).empty_section);
}

TEST_F(PresetTest, ReportsFilesThatCannotBeRead) {
  std::filesystem::create_directory(folder_ / "dir.toml");
  EXPECT_EQ(error(folder_ / "dir.toml"), folder_ / "dir.toml is a folder, expected a preset file");
  EXPECT_EQ(error(folder_ / "none.toml"), "preset file " + (folder_ / "none.toml") + " does not exist");
  const std::string locked = folder_.write("locked.toml", "");
  ::chmod(folder_.path().c_str(), 0755);
  ::chmod(locked.c_str(), 0);
  const Unprivileged unprivileged;
  EXPECT_EQ(error("locked"), locked + ": cannot read the preset: Permission denied");
}

TEST_F(PresetTest, SaysWhereItLooked) {
  EXPECT_EQ(error("fast"), "no preset 'fast' in " + folder_.path().string());
  folder_.write("first.toml", "");
  EXPECT_EQ(error("fast"), "no preset 'fast' in " + folder_.path().string() + "; the nearest is first");
  EXPECT_EQ(error_of([] { load_preset("fast", {}); }), "no preset 'fast' in no folder");
}

TEST_F(PresetTest, InheritsAndOverrides) {
  folder_.write("base.toml", "[a]\nx = 1\ny = 1\nz = 1\n");
  folder_.write("middle.toml", "inherits = \"base\"\n[a]\ny = 2\nz = 2\n");
  folder_.write("sub/leaf.toml", "inherits = \"../middle.toml\"\n[a]\nz = 3\n");
  const RawConfig values = load_preset(folder_ / "sub/leaf.toml", {});
  EXPECT_EQ(integer(values, "a.x"), 1);
  EXPECT_EQ(integer(values, "a.y"), 2);
  EXPECT_EQ(integer(values, "a.z"), 3);
  EXPECT_EQ(values.at("a.x").origin, folder_ / "base.toml:2");
}

TEST_F(PresetTest, InheritedNamesAreLookedForBesideTheFileFirst) {
  TemporaryFolder elsewhere;
  elsewhere.write("base.toml", "[a]\nx = 100\n");
  folder_.write("base.toml", "[a]\nx = 1\n");
  folder_.write("leaf.toml", "inherits = \"base\"\n");
  EXPECT_EQ(integer(load_preset(folder_ / "leaf.toml", {elsewhere.path()}), "a.x"), 1);
}

TEST_F(PresetTest, ReportsMissingParentsAndCycles) {
  const std::string leaf = folder_.write("leaf.toml", "\ninherits = \"none.toml\"\n");
  EXPECT_EQ(error("leaf"), leaf + ":2: preset file " + (folder_ / "none.toml") + " does not exist");
  const std::string self = folder_.write("self.toml", "inherits = \"self\"\n");
  EXPECT_EQ(error("self"), self + ":1: inherits goes round in a circle: self.toml -> self.toml");
  folder_.write("a.toml", "inherits = \"b\"\n");
  const std::string b = folder_.write("b.toml", "inherits = \"a\"\n");
  EXPECT_EQ(error("a"), b + ":1: inherits goes round in a circle: a.toml -> b.toml -> a.toml");
}

TEST_F(PresetTest, ListsPresetsOfAllFolders) {
  TemporaryFolder second;
  folder_.write("b.toml", "description = \"first b\"\n");
  second.write("b.toml", "description = \"hidden b\"\n");
  second.write("a.toml", "description = \"an a\"\n");
  second.write("broken.toml", "description = 1\n");
  second.write("README.md", "");
  const auto presets = list_presets({folder_.path(), second.path(), second.path() / "missing"});
  ASSERT_EQ(presets.size(), 3U);
  EXPECT_EQ(presets[0].name + ": " + presets[0].description, "a: an a");
  EXPECT_EQ(presets[1].name + ": " + presets[1].description, "b: first b");
  EXPECT_EQ(presets[2].description,
            "(not readable: " + (second / "broken.toml") + ":1: description must be text)");
}

TEST_F(PresetTest, SearchesTheEnvironmentsFoldersFirst) {
  ::setenv("PARALLAX_PRESET_PATH", "/one::/two", 1);
  const auto folders = preset_folders();
  ASSERT_EQ(folders.size(), 4U);
  EXPECT_EQ(folders[0], "/one");
  EXPECT_EQ(folders[1], "/two");
  EXPECT_EQ(folders[2].filename(), "presets");
  ::unsetenv("PARALLAX_PRESET_PATH");
  EXPECT_EQ(preset_folders().size(), 2U);
}

ConfigValue assigned(const std::string& argument) {
  return std::get<ConfigValue>(read_assignment(argument).second.value);
}

TEST(Assignment, TakesValuesAsTomlWritesThem) {
  EXPECT_EQ(read_assignment("a.b=1").first, "a.b");
  EXPECT_EQ(assigned("a=1_000"), ConfigValue(std::int64_t{1000}));
  EXPECT_EQ(assigned("a=0x10"), ConfigValue(std::int64_t{16}));
  EXPECT_EQ(assigned("a=150e6"), ConfigValue(150e6));
  EXPECT_EQ(assigned("a=true"), ConfigValue(true));
  EXPECT_EQ(assigned("a=\"b c\""), ConfigValue(std::string("b c")));
  EXPECT_EQ(assigned("a=b=c"), ConfigValue(std::string("b=c")));
  EXPECT_EQ(assigned("a=round_robin"), ConfigValue(std::string("round_robin")));
  EXPECT_EQ(assigned("a=1\nb=2"), ConfigValue(std::string("1\nb=2")));
  EXPECT_EQ(read_assignment("a=1").second.source, "command line");
  EXPECT_EQ(read_assignment(" a = 1 ").first, "a");
  EXPECT_EQ(read_assignment("a={ value = 3, tag = \"S\" }").second.tag, Tag::kStated);
}

TEST(Assignment, NamesTheArgumentThatIsNone) {
  EXPECT_EQ(error_of([] { read_assignment("a"); }), "--set a: must have the form key=value");
  EXPECT_EQ(error_of([] { read_assignment("=1"); }), "--set =1: must have the form key=value");
  EXPECT_EQ(error_of([] { read_assignment("a="); }), "--set a=: the value is empty");
}

}  // namespace preset_test
}  // namespace parallax
