// SPDX-License-Identifier: Apache-2.0
// The documentation cannot go stale: its commands run, what it shows is what they print, its code is what is
// compiled, its links lead somewhere.
#include "tests/cli/markdown.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "tests/cli/program.hpp"
#include "tests/paths.hpp"
#include "tests/platform/temporary_folder.hpp"

namespace parallax::test {
namespace documents_test {

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
void expect_shown(const std::string& page, const Command& command, const std::string& output) {
  const std::vector<std::string> printed = lines_of(output);
  std::size_t next = 0;
  for (const std::string& line : command.shown) {
    if (line == "...") continue;
    while (next < printed.size() && !shows(line, printed[next])) ++next;
    ASSERT_LT(next, printed.size()) << page << ":" << command.line << ": " << command.text
                                    << "\ndoes not print (here): " << line << "\nbut\n"
                                    << output;
    ++next;
  }
}

// The Markdown files of a folder of the checkout, by their names from the root.
void add_pages(const std::string& folder, std::vector<std::string>& pages) {
  for (const auto& entry : fs::directory_iterator(source_path(folder))) {
    if (entry.path().extension() == ".md")
      pages.push_back((fs::path(folder) / entry.path().filename()).lexically_normal().string());
  }
}

// What a user reads; each page's commands run in a folder of their own, in this order.
std::vector<std::string> pages_with_commands() {
  std::vector<std::string> pages{"README.md", "CONTRIBUTING.md"};
  add_pages("platform/doc", pages);
  std::sort(pages.begin(), pages.end());
  return pages;
}

std::vector<std::string> all_pages() {
  std::vector<std::string> pages;
  for (const char* folder : {".", "tlm", "modules", "platform", "platform/doc", "platform/presets", "traces",
                             "tests", "tests/bench"}) {
    add_pages(folder, pages);
  }
  return pages;
}

class Page : public ::testing::TestWithParam<std::string> {};

TEST_P(Page, EveryCommandRunsAndPrintsWhatIsShown) {
  if (sanitized()) GTEST_SKIP() << "minutes with sanitizers, and nothing that other tests do not run";
  const std::string& page = GetParam();
  const TemporaryFolder folder;
  // The reference circuits, where the checkout has them.
  fs::create_directory(folder.path() / "modules");
  fs::create_directory_symlink(source_path("modules/rtl"), folder.path() / "modules/rtl");
  for (const FencedBlock& block : fenced_blocks(read_text(source_path(page)))) {
    if (block.language == "sh") {
      EXPECT_EQ(block.note.rfind("not run: ", 0), 0u)
          << page << ":" << block.line << ": an sh block needs a comment that says why no test runs it";
    }
    if (block.language == "verilog" || block.language == "vhdl" ||
        (block.language == "toml" && fs::path(block.note).extension() ==
                                         ".toml")) {  // a file of the reader's, whose name is in the comment
      std::string content;
      for (const std::string& line : block.lines) content += line + "\n";
      folder.write(block.note, content);
    }
    if (block.language != "console") continue;
    for (const Command& command : commands_of(block)) {
      std::string output;
      EXPECT_EQ(run_in(folder, command.text, output), command.exit_code)
          << page << ":" << command.line << ": " << command.text << "\n"
          << output;
      expect_shown(page, command, output);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Documents, Page, ::testing::ValuesIn(pages_with_commands()),
                         [](const auto& page) { return fs::path(page.param).stem().string(); });

// Whether a page shows a command line that begins with these words.
bool shown_on_a_page(const std::string& words) {
  for (const std::string& page : pages_with_commands()) {
    for (const FencedBlock& block : fenced_blocks(read_text(source_path(page)))) {
      if (block.language != "console") continue;
      for (const Command& command : commands_of(block)) {
        if (command.text.find(words) != std::string::npos) return true;
      }
    }
  }
  return false;
}

TEST(Documents, EveryCommandOfTheProgramIsOnAPage) {
  const std::string help = Program()("--help").out;
  const std::vector<std::string> lines = lines_of(help.substr(help.find("Subcommands:")));
  ASSERT_GE(lines.size(), 10u) << help;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (lines[i].rfind("  ", 0) != 0 || lines[i][2] == ' ') continue;  // what a command does, continued
    const std::string command = lines[i].substr(2, lines[i].find(' ', 2) - 2);
    EXPECT_TRUE(shown_on_a_page("parallax " + command)) << command << ": show it on a page of platform/doc";
  }
}

TEST(Documents, LinesAreComparedByTextAndNumbers) {
  EXPECT_TRUE(shows("rate  100.2 fps", "rate 100.4 fps"));
  EXPECT_FALSE(shows("rate 100 fps", "rate 120 fps"));
  EXPECT_FALSE(shows("rate 100 fps", "frame rate 100 fps"));
  EXPECT_TRUE(shows("error: x ...", "error: x is 5"));
  EXPECT_FALSE(shows("error: x", "error: x is 5"));
}

TEST(Documents, TheReadmeIsShort) { EXPECT_LE(lines_of(read_text(source_path("README.md"))).size(), 400u); }

TEST(Documents, TheirCodeIsWhatTheTestsCompile) {
  std::size_t count = 0;
  for (const std::string& page : all_pages()) {
    for (const FencedBlock& block : fenced_blocks(read_text(source_path(page)))) {
      if (block.language != "cpp" && block.language != "cmake" && block.language != "systemverilog") continue;
      std::string code;
      for (const std::string& line : block.lines) code += line + "\n";
      EXPECT_NE(read_text(source_path(block.note)).find(code), std::string::npos)
          << page << ":" << block.line << " is not a part of " << block.note;
      ++count;
    }
  }
  EXPECT_GE(count, 5u);
}

TEST(Documents, LinksLeadSomewhere) {
  for (const std::string& page : all_pages()) {
    for (const std::string& link : links_of(read_text(source_path(page)))) {
      if (link.rfind("http", 0) == 0) continue;
      const std::size_t hash = std::min(link.find('#'), link.size());
      const std::string target =
          hash == 0 ? page
                    : (fs::path(page).parent_path() / link.substr(0, hash)).lexically_normal().string();
      ASSERT_TRUE(fs::exists(source_path(target))) << page << " links to " << link;
      if (hash == link.size()) continue;
      EXPECT_EQ(anchors_of(read_text(source_path(target))).count(link.substr(hash + 1)), 1u)
          << page << " links to " << link << ", which is no heading there";
    }
  }
}

TEST(Documents, TheReadmeLeadsToEveryPage) {
  const std::vector<std::string> links = links_of(read_text(source_path("README.md")));
  for (const std::string& page : pages_with_commands()) {
    if (page == "README.md") continue;
    EXPECT_EQ(std::count(links.begin(), links.end(), page) > 0, true) << page;
  }
}

}  // namespace documents_test
}  // namespace parallax::test
