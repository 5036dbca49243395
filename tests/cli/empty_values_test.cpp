// SPDX-License-Identifier: Apache-2.0
// An empty value is no value: of no option of no command is it taken for one that was not given.
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <sstream>

#include "platform/commands/cli.hpp"
#include "platform/commands/command_context.hpp"

namespace parallax {
namespace empty_values_test {

struct Case {
  std::vector<std::string> command;  ///< "map", "encode"
  std::string option;                ///< "--out"; empty: an argument
  std::size_t before = 0;            ///< arguments before it
};

void collect(const CLI::App& app, const std::vector<std::string>& command, std::vector<Case>& cases) {
  std::size_t arguments = 0;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_items_expected_max() == 0) continue;
    if (option->get_positional()) {
      cases.push_back({command, "", arguments++});
    } else {
      for (const std::string& name : option->get_lnames()) cases.push_back({command, "--" + name, 0});
      for (const std::string& name : option->get_snames()) cases.push_back({command, "-" + name, 0});
    }
  }
  for (const CLI::App* inner : app.get_subcommands([](const CLI::App*) { return true; })) {
    std::vector<std::string> longer = command;
    if (!inner->get_name().empty() && inner->get_group() != "" && inner->get_name() != "source")
      longer.push_back(inner->get_name());
    collect(*inner, longer, cases);
  }
}

TEST(EmptyValues, AreRefusedByEveryOptionOfEveryCommand) {
  CLI::App app("", "parallax");
  CommandContext context{std::cout, std::cerr, CommandLine(0, nullptr)};
  add_commands(app, context);
  std::vector<Case> cases;
  collect(app, {}, cases);
  EXPECT_GT(cases.size(), 50U);
  for (const Case& one : cases) {
    std::vector<std::string> words{"parallax"};
    words.insert(words.end(), one.command.begin(), one.command.end());
    for (std::size_t i = 0; i < one.before; ++i) words.emplace_back("x");
    if (!one.option.empty()) words.push_back(one.option);
    words.emplace_back("");
    std::vector<const char*> argv;
    std::string line;
    for (const std::string& word : words) {
      argv.push_back(word.c_str());
      line += word + ' ';
    }
    std::ostringstream out, err;
    EXPECT_EQ(run_command_line(static_cast<int>(argv.size()), argv.data(), out, err), 2) << line;
    EXPECT_EQ(out.str(), "") << line;
    EXPECT_NE(err.str().find("the value is empty"), std::string::npos) << line << err.str();
  }
}

}  // namespace empty_values_test
}  // namespace parallax
