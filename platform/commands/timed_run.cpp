// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/timed_run.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "platform/commands/common_options.hpp"
#include "platform/commands/input_options.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

// The same declarations as those of `parallax run`: one wording, one check.
void add_options(CLI::App& command, RunOptions& options) {
  command.option_defaults()->take_last();
  add_input_options(command, options);
  add_timing_frames_option(command, options);
  add_configuration_options(command, options.configuration);
  refuse_empty_values(command);
}

}  // namespace

std::vector<std::string> timed_run_options() {
  CLI::App command;
  RunOptions options;
  add_options(command, options);
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      if (name != "help" && name != "set") names.push_back(name);
    }
  }
  return names;
}

std::vector<std::string> command_words(const std::vector<RunWord>& words) {
  std::vector<std::string> all;
  for (const RunWord& word : words) {
    all.push_back("--" + word.option);
    all.insert(all.end(), word.values.begin(), word.values.end());
  }
  return all;
}

RunOptions timed_run(const std::vector<RunWord>& words) {
  CLI::App command;
  RunOptions options;
  add_options(command, options);
  std::vector<std::string> backwards = command_words(words);
  std::reverse(backwards.begin(), backwards.end());  // as the library takes them
  try {
    command.parse(backwards);
  } catch (const CLI::ExtrasError&) {
    throw UserError("unexpected argument '" + excerpt(command.remaining().front()) + "'");
  } catch (const CLI::ParseError& error) {
    throw UserError(excerpt(error.what(), 300));
  }
  options.timing_only = true;
  return options;
}

}  // namespace parallax
