// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/input_options.hpp"

#include <CLI/CLI.hpp>

#include "platform/commands/common_options.hpp"

namespace parallax {

void add_input_options(CLI::App& command, RunOptions& options) {
  command.add_option("--left", options.left, "Left image")->type_name("FILE")->group("Input");
  command.add_option("--right", options.right, "Right image")->type_name("FILE")->group("Input");
  command
      .add_option("--input", options.input,
                  "A sequence: a folder of pairs, or a list file with two paths a line")
      ->type_name("PATH")
      ->group("Input");
  command
      .add_option("--frames", options.frames,
                  "At most so many frames of a sequence; frames of the built-in scene")
      ->group("Input");
  command.add_option("--size", options.size, "Size of the built-in scene, 640x480 if not given")
      ->type_name("WxH")
      ->group("Input");
  command.option_defaults()->group("Input");
  add_seed_option(command, options.scene.seed, "Seed of the built-in scene");
  command.option_defaults()->group("Options");
  command.add_flag("--rectified", options.rectified, "Built-in scene without lens distortion")
      ->group("Input");
  command
      .add_option(
          "--image-bits", options.image_bits,
          "Bits of the values in 16-bit images, 8 to 16; if not given, as many as the largest value of "
          "the sequence asks for")
      ->type_name("COUNT")
      ->group("Input");
  command
      .add_option("--calibration", options.calibration,
                  "Calibration: OpenCV, ROS (two files, left and right), Kalibr, KITTI, Middlebury, "
                  "VINS-Fusion or ORB-SLAM, told by its content. Raw images are rectified by it, the point "
                  "cloud has its scale")
      ->type_name("FILE")
      ->take_all()
      ->group("Rectification");
  command.add_option("--cameras", options.cameras, kCamerasHelp)->type_name("L,R")->group("Rectification");
  command
      .add_option("--map", options.map,
                  "The images are not rectified: compressed map of `parallax map encode`")
      ->type_name("FILE")
      ->group("Rectification");
  command
      .add_flag("--fit", options.fit, "Zoom and shift the rectified images until the offsets fit the window")
      ->group("Rectification");
}

void add_timing_frames_option(CLI::App& command, RunOptions& options) {
  command
      .add_option(
          "--timing-frames", options.timing_frames,
          "Least number of frames to simulate; beyond the input, frames are timed without images. If not "
          "given: so many that all buffers have been full, and three more")
      ->group("Timing");
}

}  // namespace parallax
