// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/ask_command.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "platform/commands/ask.hpp"
#include "platform/commands/command_context.hpp"
#include "platform/commands/common_options.hpp"
#include "platform/commands/input_options.hpp"

namespace parallax {

void add_ask_command(CLI::App& app, CommandContext& context) {
  const auto options = std::make_shared<AskOptions>();
  CLI::App& command =
      *app.add_subcommand("ask", "The least or largest value of a key with which a machine holds a bound");
  command.option_defaults()->take_last();
  command.add_option("which", options->which, "least or most")->required();
  command.add_option("key", options->key, "Configuration key, a number")->type_name("KEY")->required();
  command
      .add_option(
          "--hold", options->hold,
          "What must hold, of a number of a run: performance/frame_rate>=60, or <= where less is better")
      ->type_name("NUMBER>=VALUE")
      ->required()
      ->multi_option_policy(CLI::MultiOptionPolicy::Throw);
  command
      .add_option("--from", options->from,
                  "Least value to look at; an eighth of the one that the machine has, if not given")
      ->type_name("VALUE");
  command.add_option("--to", options->to, "Largest value to look at; eight times the one that it has")
      ->type_name("VALUE");
  add_input_options(command, options->run);
  add_timing_frames_option(command, options->run);
  add_configuration_options(command, options->run.configuration);
  add_json_option(command, options->run.json);
  command.callback([options, &context] {
    options->run.timing_only = true;
    context.action = [options, &context] { return ask(*options, context); };
  });
}

}  // namespace parallax
