// SPDX-License-Identifier: Apache-2.0
#include "platform/run_command.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "platform/command_context.hpp"
#include "platform/common_options.hpp"
#include "platform/run.hpp"

namespace parallax {

void add_run_command(CLI::App& app, CommandContext& context) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App& command = *app.add_subcommand(
      "run",
      "Stereo pairs through the whole machine: disparity maps and timing. Without input: the built-in scene");
  command.option_defaults()->take_last();

  command.add_option("--left", options->left, "Left image")->type_name("FILE")->group("Input");
  command.add_option("--right", options->right, "Right image")->type_name("FILE")->group("Input");
  command
      .add_option("--input", options->input,
                  "A sequence: a folder of pairs, or a list file with two paths a line")
      ->type_name("PATH")
      ->group("Input");
  command
      .add_option("--frames", options->frames,
                  "At most so many frames of a sequence; frames of the built-in scene")
      ->group("Input");
  command.add_option("--size", options->size, "Size of the built-in scene, 640x480 if not given")
      ->type_name("WxH")
      ->group("Input");
  command.add_option("--seed", options->scene.seed, "Seed of the built-in scene")
      ->capture_default_str()
      ->group("Input");
  command.add_flag("--rectified", options->rectified, "Built-in scene without lens distortion")
      ->group("Input");
  command
      .add_option("--ground-truth", options->ground_truth,
                  "True disparities of a pair: 16-bit PNG, disparity * 256, 0 = unknown")
      ->type_name("FILE")
      ->group("Input");
  command.add_option("--mask", options->mask, "Pixels to score: 8-bit PNG, 255 = score")
      ->type_name("FILE")
      ->group("Input");

  command
      .add_option("--calibration", options->calibration,
                  "The images are not rectified: OpenCV calibration file, or files that complete each other")
      ->type_name("FILE")
      ->take_all()
      ->group("Rectification");
  command
      .add_option("--map", options->map,
                  "The images are not rectified: compressed map of `parallax map encode`")
      ->type_name("FILE")
      ->group("Rectification");
  command
      .add_flag("--fit", options->fit, "Zoom and shift the rectified images until the offsets fit the window")
      ->group("Rectification");

  command.add_option("--out", options->out, "Folder for the results; without it only the summary is printed")
      ->type_name("DIR")
      ->group("Output");
  command.add_flag("!--no-point-cloud", options->point_cloud, "Do not write points.ply")->group("Output");
  command
      .add_option("--timing-frames", options->timing_frames,
                  "Least number of frames to simulate; beyond the input, frames are timed without images")
      ->capture_default_str()
      ->group("Output");
  add_json_option(command, options->json);
  add_configuration_options(command, options->configuration);
  command.callback(
      [options, &context] { context.action = [options, &context] { return run(*options, context); }; });
}

}  // namespace parallax
