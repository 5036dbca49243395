// SPDX-License-Identifier: Apache-2.0
#include "platform/python/run_line.hpp"

#include <CLI/CLI.hpp>
#include <sstream>

#include "platform/commands/common_options.hpp"
#include "platform/commands/parse_line.hpp"
#include "platform/commands/run_command.hpp"
#include "platform/input/run_input.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

// As main() has it; valid as long as `words`.
std::vector<const char*> arguments(const std::vector<std::string>& words) {
  std::vector<const char*> all{"parallax", "run"};
  for (const std::string& word : words) all.push_back(word.c_str());
  return all;
}

}  // namespace

CommandLine run_line(const std::vector<std::string>& words) {
  const std::vector<const char*> all = arguments(words);
  return {static_cast<int>(all.size()), all.data()};
}

std::shared_ptr<RunOptions> run_options(const std::vector<std::string>& words) {
  CLI::App app("", "parallax");
  CLI::App& command = *app.add_subcommand("run");
  auto options = add_run_options(command);
  refuse_empty_values(app);
  const std::vector<const char*> all = arguments(words);
  std::ostringstream help;
  if (parse_line(app, static_cast<int>(all.size()), all.data(), help))
    throw UserError("help is the command line's: parallax run --help");
  if (!options->vary.empty())
    throw UserError("vary is the command line's: here evaluate() times many points");
  if (options->relax) throw UserError("relax is the command line's: parallax run --timing-only --relax");
  if (!options->circuits.empty()) throw UserError("circuits are the command line's: parallax run --circuit");
  return options;
}

}  // namespace parallax
