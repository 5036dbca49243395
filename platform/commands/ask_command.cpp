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
  CLI::App& command = *app.add_subcommand(
      "ask", "The least that holds, the cheapest of many machines, or what a change brings");
  command.option_defaults()->take_last();
  command.add_option("which", options->which, "least, most, or effect")->required();
  command
      .add_option(
          "subject", options->subjects,
          "Of least and most a configuration key; with --vary a number of a run or an estimate, or a key "
          "that varies. Of effect KEY=VALUE, as often as there are changes")
      ->type_name("WHAT")
      ->required()
      ->take_all();
  command
      .add_option(
          "--hold", options->holds,
          "What must hold, of a number of a run or an estimate: performance/frame_rate>=60, or <= where "
          "less is better. Repeated, all of them")
      ->type_name("NUMBER>=VALUE")
      ->allow_extra_args(false)
      ->take_all();
  command
      .add_option("--vary", options->run.vary,
                  "Machines to choose from: each combination of the values of keys, or of size, preset, "
                  "disparities, input, calibration or map; start:stop:step stands for a range of numbers")
      ->type_name("KEY=VALUE,...")
      ->allow_extra_args(false)
      ->take_all();
  command
      .add_option(
          "--device", options->device,
          "FPGA whose shares are numbers, too (devices/zynq_7020/fits): a name such as zynq-7020, or a "
          "file")
      ->type_name("NAME");
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
