// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/parse_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "platform/config/nearest_name.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

/// What could have been written where `word` stands: the options, or the commands.
std::vector<std::string> alternatives(const CLI::App& app, const std::string& word) {
  std::vector<std::string> names;
  if (word.rfind('-', 0) != 0) {
    for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
    return names;
  }
  const auto add_options = [&names](const CLI::App& owner) {
    for (const CLI::Option* option : owner.get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
  };
  for (const CLI::App* command : app.get_subcommands()) add_options(*command);
  add_options(app);
  return names;
}

/// The words that no option and no command took.
std::string unexpected(const CLI::App& app, const std::string& argument) {
  const std::string word = argument.substr(0, argument.find('='));
  const bool is_option = word.rfind('-', 0) == 0;
  if (!is_option && !app.get_subcommands().empty())
    return fmt::format("unexpected argument '{}'", excerpt(argument));
  return fmt::format("unknown {} {}; the nearest is {}", is_option ? "option" : "command", excerpt(word),
                     nearest_name(word, alternatives(app, word)));
}

// A message of CLI11 quotes what it could not read, however long that is, and some quote all that is allowed.
constexpr std::size_t kLongestParseError = 300;

}  // namespace

bool parse_line(CLI::App& app, int argc, const char* const* argv, std::ostream& out) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {
    app.exit(request, out, out);
    return true;
  } catch (const CLI::ExtrasError&) {
    throw UserError(unexpected(app, app.remaining(true).front()));
  } catch (const CLI::ParseError& error) {
    throw UserError(excerpt(error.what(), kLongestParseError));
  }
  return false;
}

}  // namespace parallax
