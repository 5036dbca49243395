// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/fifos_command.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "platform/commands/command_context.hpp"
#include "platform/commands/common_options.hpp"
#include "platform/commands/fifos.hpp"
#include "platform/commands/input_options.hpp"

namespace parallax {

void add_fifos_command(CLI::App& app, CommandContext& context) {
  const auto options = std::make_shared<FifosOptions>();
  CLI::App& command = *app.add_subcommand(
      "fifos",
      "The smallest FIFO depths of the pipeline for its full rate, for a given one, or without deadlock");
  command
      .add_option("--goal", options->goal,
                  "full-rate: that of the machine with deep FIFOs; deadlock-free: that all frames come out")
      ->type_name("GOAL")
      ->capture_default_str()
      ->group("Goal");
  command.add_option("--rate", options->rate, "Another goal: so many frames/s")
      ->type_name("FPS")
      ->group("Goal");
  command
      .add_option("--tolerance", options->tolerance,
                  "Of the full rate: by how much a frame may take longer, 0.001 if not given; 0: not by a "
                  "picosecond")
      ->type_name("PERCENT")
      ->group("Goal");
  command
      .add_flag("--front", options->front,
                "Also what machines with less memory do, down to the smallest without deadlock")
      ->group("Goal");
  command
      .add_option("--timing-frames", options->run.timing_frames,
                  "Number of frames of each run; if not given: so many that all buffers have been full, and "
                  "three more")
      ->group("Goal");
  add_input_options(command, options->run);
  command
      .add_option("--out", options->run.out,
                  "Folder for fifos.json, and depths.toml, the machine with these depths as a preset")
      ->type_name("DIR")
      ->group("Output");
  add_json_option(command, options->run.json);
  add_configuration_options(command, options->run.configuration);
  command.callback(
      [options, &context] { context.action = [options, &context] { return fifos(*options, context); }; });
}

}  // namespace parallax
