// SPDX-License-Identifier: Apache-2.0
// The README cannot go stale: its commands run, what it shows is what they print, its code is what is
// compiled, its glossary names what timing.json holds, its links lead somewhere.
#include "tests/cli/readme.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/paths.hpp"
#include "tests/platform/temporary_folder.hpp"

namespace parallax::test {
namespace {

namespace fs = std::filesystem;

int run_in(const TemporaryFolder& folder, const std::string& command, std::string& output) {
  folder.write("command", command);
  const std::string line =
      fmt::format("cd '{}' && PATH='{}':\"$PATH\" bash ./command > output 2>&1 < /dev/null",
                  folder.path().string(), fs::path(program_path()).parent_path().string());
  const int status = std::system(line.c_str());
  output = folder.read("output");
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Lines shown in this order; "..." stands for any that are left out.
void expect_shown(const Command& command, const std::string& output) {
  const std::vector<std::string> printed = lines_of(output);
  std::size_t next = 0;
  for (const std::string& line : command.shown) {
    if (line == "...") continue;
    while (next < printed.size() && !shows(line, printed[next])) ++next;
    ASSERT_LT(next, printed.size()) << "README.md:" << command.line << ": " << command.text
                                    << "\ndoes not print (here): " << line << "\nbut\n"
                                    << output;
    ++next;
  }
}

TEST(Readme, EveryCommandRunsAndPrintsWhatIsShown) {
#ifdef PARALLAX_SANITIZED
  GTEST_SKIP() << "minutes with sanitizers, and nothing that other tests do not run";
#endif
  const TemporaryFolder folder;
  std::size_t count = 0;
  for (const FencedBlock& block : fenced_blocks(read_text(source_path("README.md")))) {
    if (block.language == "sh") {
      EXPECT_EQ(block.note.rfind("not run: ", 0), 0u)
          << "README.md:" << block.line << ": an sh block needs a comment that says why no test runs it";
    }
    if (block.language != "console") continue;
    for (const Command& command : commands_of(block)) {
      std::string output;
      EXPECT_EQ(run_in(folder, command.text, output), command.exit_code)
          << "README.md:" << command.line << ": " << command.text << "\n"
          << output;
      expect_shown(command, output);
      ++count;
    }
  }
  EXPECT_GE(count, 10u);
}

TEST(Readme, LinesAreComparedByTextAndNumbers) {
  EXPECT_TRUE(shows("rate  100.2 fps", "rate 100.4 fps"));
  EXPECT_FALSE(shows("rate 100 fps", "rate 120 fps"));
  EXPECT_FALSE(shows("rate 100 fps", "frame rate 100 fps"));
  EXPECT_TRUE(shows("error: x ...", "error: x is 5"));
  EXPECT_FALSE(shows("error: x", "error: x is 5"));
}

TEST(Readme, ItsCodeIsWhatTheTestsCompile) {
  std::size_t count = 0;
  for (const char* file : {"README.md", "tlm/README.md", "modules/README.md"}) {
    for (const FencedBlock& block : fenced_blocks(read_text(source_path(file)))) {
      if (block.language != "cpp" && block.language != "cmake") continue;
      std::string code;
      for (const std::string& line : block.lines) code += line + "\n";
      EXPECT_NE(read_text(source_path(block.note)).find(code), std::string::npos)
          << file << ":" << block.line << " is not a part of " << block.note;
      ++count;
    }
  }
  EXPECT_GE(count, 2u);
}

void collect(const nlohmann::json& tree, const std::string& path, std::map<std::string, std::string>& units) {
  for (const auto& [key, value] : tree.items()) {
    if (path.empty() && key == "configuration") continue;
    if (value.is_object() && value.contains("value") && value.contains("description")) {
      units[path + key] = value.value("unit", "");
    } else if (value.is_object()) {
      collect(value, path + key + "/", units);
    }
  }
}

bool matches(const std::string& pattern, const std::string& name) {
  static const std::regex placeholder("<[a-z_]+>");
  return std::regex_match(name, std::regex(std::regex_replace(pattern, placeholder, "[a-z0-9_]+")));
}

TEST(Readme, TheGlossaryNamesEveryMetricAndNoOther) {
  const TemporaryFolder folder;
  std::string output;
  ASSERT_EQ(run_in(folder, "parallax run --size 320x240 -d 64 --json", output), 0) << output;
  std::map<std::string, std::string> units;
  collect(nlohmann::json::parse(output), "", units);
  ASSERT_EQ(
      run_in(folder, "parallax run --size 96x64 --set streams.left_output.depth=4 --json 2>stuck", output),
      1);
  collect(nlohmann::json::parse(output), "", units);
  const std::vector<GlossaryEntry> glossary = glossary_of(read_text(source_path("README.md")));
  for (const auto& [name, unit] : units) {
    const auto entry = std::find_if(glossary.begin(), glossary.end(),
                                    [&, metric = name](const auto& e) { return matches(e.name, metric); });
    ASSERT_NE(entry, glossary.end()) << "the glossary of README.md lacks " << name;
    EXPECT_EQ(entry->unit, unit.empty() ? "-" : unit) << name;
  }
  for (const GlossaryEntry& entry : glossary) {
    EXPECT_TRUE(std::any_of(units.begin(), units.end(),
                            [&](const auto& metric) { return matches(entry.name, metric.first); }))
        << "timing.json has no " << entry.name;
    EXPECT_GT(entry.meaning.size(), 10u) << entry.name;
  }
}

TEST(Readme, LinksLeadSomewhere) {
  const std::regex link("\\]\\(([^)#:]+)\\)");
  const std::vector<std::string> folders{"",        "tlm/",  "modules/", "platform/", "platform/presets/",
                                         "traces/", "tests/"};
  for (const std::string& folder : folders) {
    const std::string text = read_text(source_path(folder + "README.md"));
    for (std::sregex_iterator i(text.begin(), text.end(), link), end; i != end; ++i) {
      EXPECT_TRUE(fs::exists(source_path(folder + (*i)[1].str())))
          << folder << "README.md links to " << (*i)[1];
    }
  }
}

}  // namespace
}  // namespace parallax::test
