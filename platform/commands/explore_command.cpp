// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/explore_command.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "platform/commands/command_context.hpp"
#include "platform/commands/common_options.hpp"
#include "platform/commands/explore.hpp"

namespace parallax {

void add_explore_command(CLI::App& app, CommandContext& context) {
  const auto options = std::make_shared<ExploreOptions>();
  CLI::App& command = *app.add_subcommand(
      "explore", "Many machines, timed: sweeps and samples with constraints, and the best of them");
  command.option_defaults()->take_last();
  command
      .add_option("spec", options->spec, "What varies, what must hold and what is to be best: a TOML file")
      ->type_name("SPEC")
      ->required();
  command
      .add_option("--out", options->out,
                  "Folder for the results: results.db, points.csv, front.csv. Points that it knows are not "
                  "evaluated again")
      ->type_name("DIR")
      ->required();
  command
      .add_option("--shard", options->shard,
                  "Evaluate this part of the points alone, the second of four: 2/4; parallax merge puts "
                  "parts together")
      ->type_name("I/N");
  command
      .add_option("--emit", options->emit,
                  "Evaluate nothing; write a job for this engine, whose tasks have a shard each: slurm, "
                  "parallel (GNU), "
                  "lsf or sge")
      ->type_name("ENGINE");
  command.add_option("--tasks", options->tasks, "How many tasks that job has")->type_name("N");
  add_json_option(command, options->json);
  command.callback(
      [options, &context] { context.action = [options, &context] { return explore(*options, context); }; });
}

void add_merge_command(CLI::App& app, CommandContext& context) {
  const auto options = std::make_shared<MergeOptions>();
  CLI::App& command =
      *app.add_subcommand("merge", "One folder of those of an exploration's shards, and the best of all");
  command.option_defaults()->take_last();
  command.add_option("spec", options->spec, "What was explored: a TOML file")->type_name("SPEC")->required();
  command.add_option("folders", options->folders, "Folders of its shards")
      ->type_name("DIR...")
      ->required()
      ->take_all();
  command
      .add_option("--out", options->out,
                  "Folder for the whole: results.db, points.csv, front.csv. What it has stays")
      ->type_name("DIR")
      ->required();
  add_json_option(command, options->json);
  command.callback(
      [options, &context] { context.action = [options, &context] { return merge(*options, context); }; });
}

}  // namespace parallax
