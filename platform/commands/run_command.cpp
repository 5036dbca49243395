// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/run_command.hpp"

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "platform/commands/circuit_arguments.hpp"
#include "platform/commands/command_context.hpp"
#include "platform/commands/common_options.hpp"
#include "platform/commands/input_options.hpp"
#include "platform/commands/run.hpp"

namespace parallax {

std::shared_ptr<RunOptions> add_run_options(CLI::App& command) {
  auto options = std::make_shared<RunOptions>();
  command.option_defaults()->take_last();

  add_input_options(command, *options);
  command
      .add_option("--ground-truth", options->ground_truth,
                  "True disparities of a pair: PNG or TIFF of 8 or 16 bits, float TIFF, PFM, NPY or NPZ "
                  "(FILE.npz:NAME where it holds several arrays); 0 = unknown")
      ->type_name("FILE")
      ->group("Input");
  command
      .add_option("--ground-truth-scale", options->ground_truth_scale,
                  "True disparity = value / this; if not given, 256 for 16-bit integers and 1 for others")
      ->type_name("NUMBER")
      ->group("Input");
  command
      .add_option(
          "--ground-truth-encoding", options->ground_truth_encoding,
          "How an image holds them: values, or sintel, 8-bit colours with 4 R + G / 64 + B / 16384 px; "
          "values if not given")
      ->type_name("NAME")
      ->group("Input");
  command.add_option("--mask", options->mask, "Pixels to score: 8-bit PNG, 255 = score")
      ->type_name("FILE")
      ->group("Input");

  command
      .add_flag("--timing-only", options->timing_only,
                "Compute no images, only when everything happens: the same dates, much sooner")
      ->group("Timing");
  command
      .add_option("--vary", options->vary,
                  "With --timing-only: one run for each value of a configuration key, or of size, preset, "
                  "disparities, input, calibration or map; start:stop:step stands for a range of numbers. "
                  "Repeated, for each combination, the last one changing fastest")
      ->type_name("KEY=VALUE,...")
      ->allow_extra_args(false)
      ->take_all()
      ->group("Timing");
  command
      .add_flag("--relax", options->relax,
                "With --timing-only: what limits? One run with each limit alone taken away, sorted by what "
                "it gains; with --vary at each point")
      ->group("Timing");
  command
      .add_flag("!--no-verdict", options->verdict,
                "Do not run the machine once more without its limit to say what that would gain")
      ->group("Timing");
  command.add_option("--out", options->out, "Folder for the results; without it only the summary is printed")
      ->type_name("DIR")
      ->group("Output");
  command
      .add_flag("--report", options->report,
                "Write report.html too, one page with all of it, and try what taking away each limit gains. "
                "Needs --out")
      ->group("Output");
  command.add_flag("!--no-point-cloud", options->point_cloud, "Do not write points.ply")->group("Output");
  add_timing_frames_option(command, *options);
  command
      .add_option("--trace", options->trace.formats,
                  "Write what happened when: perfetto (trace.pftrace), vcd, csv (trace_*.csv), json; several "
                  "separated by "
                  "commas. Needs --out")
      ->type_name("FORMAT,...")
      ->group("Trace");
  command
      .add_option("--trace-level", options->trace.level,
                  "rows: a span for each stage and row, with what it waited for; tokens: every firing, token "
                  "and burst")
      ->type_name("LEVEL")
      ->group("Trace");
  command
      .add_option(
          "--trace-from", options->trace.from,
          "Begin of what is traced: a frame (8, counted from 1), a row of it (8:120), or a time (12.5ms)")
      ->type_name("WHEN")
      ->group("Trace");
  command
      .add_option("--trace-to", options->trace.to,
                  "Its end, likewise; that frame and row are traced, that time is not")
      ->type_name("WHEN")
      ->group("Trace");
  command
      .add_option("--trace-parts", options->trace.parts,
                  "Stages and memory ports that are traced, a stage with its streams; all if not given")
      ->type_name("NAME,...")
      ->group("Trace");
  add_circuit_options(command, options->circuits, options->circuit_shadow);
  add_json_option(command, options->json);
  add_configuration_options(command, options->configuration);
  return options;
}

void add_run_command(CLI::App& app, CommandContext& context) {
  CLI::App& command = *app.add_subcommand(
      "run",
      "Stereo pairs through the whole machine: disparity maps and timing. Without input: the built-in scene");
  const std::shared_ptr<RunOptions> options = add_run_options(command);
  command.callback(
      [options, &context] { context.action = [options, &context] { return run(*options, context); }; });
}

}  // namespace parallax
