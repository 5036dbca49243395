// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/scene_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "platform/commands/command_context.hpp"
#include "platform/commands/common_options.hpp"
#include "platform/images/image_codecs.hpp"
#include "platform/results/output_folder.hpp"
#include "platform/results/result_images.hpp"
#include "platform/scene/scene.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

struct SceneOptions {
  SceneConfig config;
  std::filesystem::path out;
  std::string size = "640x480";
  int frames = 1;
  bool rectified = false;
};

constexpr std::array<const char*, 4> kImages{"disp_gt", "mask_nocc", "left", "right"};

void read_size(const std::string& text, SceneConfig& config) {
  int width = 0, height = 0, used = 0;
  if (std::sscanf(text.c_str(), "%5dx%5d%n", &width, &height, &used) != 2 ||
      static_cast<std::size_t>(used) != text.size()) {
    throw UserError(fmt::format("--size is '{}', expected width x height such as 640x480", excerpt(text)));
  }
  config.width = width;
  config.height = height;
}

/// Whether a scene of `frames` frames, counted with `digits` digits, has a file of this name.
bool is_of_scene(const std::string& name, int frames, int digits) {
  if (name == "calib.yml") return true;
  for (const char* const image : kImages) {
    const std::string prefix = image;
    if (name.compare(0, prefix.size(), prefix) != 0) continue;
    const std::string rest = name.substr(prefix.size());
    if (frames == 1 && rest == ".png") return true;
    int frame = 0, used = 0;
    if (frames > 1 && std::sscanf(rest.c_str(), "_%9d.png%n", &frame, &used) == 1 && frame >= 0 &&
        frame < frames && rest == fmt::format("_{:0{}}.png", frame, digits)) {
      return true;
    }
  }
  return false;
}

int write_scene(SceneOptions options) {
  read_size(options.size, options.config);
  options.config.distortion = !options.rectified;
  if (options.frames < 1) {
    throw UserError(fmt::format("--frames is {}, allowed is 1 and more", options.frames));
  }
  const Scene scene(options.config);
  const int digits = std::max<int>(2, static_cast<int>(std::to_string(options.frames - 1).size()));
  FolderPlan plan;
  plan.writes = [&](const std::string& name) { return is_of_scene(name, options.frames, digits); };
  OutputFolder folder(options.out, std::move(plan));
  folder.write("calib.yml", to_yaml(scene.calibration()));
  for (int frame = 0; frame < options.frames; ++frame) {
    const StereoImages images = scene.render(frame);
    const SceneTruth truth = scene.truth(frame);
    const std::string suffix = options.frames == 1 ? ".png" : fmt::format("_{:0{}}.png", frame, digits);
    const auto write = [&](const char* name, const cv::Mat& image) {
      folder.write(name + suffix, encode_image(".png", image));
    };
    write("disp_gt", truth.disparity);
    write("mask_nocc", truth.mask);
    write("left", images.left);
    write("right", images.right);
    folder.publish();
  }
  return 0;
}

}  // namespace

void add_scene_command(CLI::App& app, CommandContext& context) {
  const auto options = std::make_shared<SceneOptions>();
  CLI::App& command = *app.add_subcommand(
      "scene", "Write the built-in scene: a stereo pair or sequence with calibration and exact ground truth");
  SceneConfig& config = options->config;
  command.add_option("--out", options->out, "Folder for the files")->required();
  command.add_option("--size", options->size, "Width x height, 1x1 to 1856x1856")->capture_default_str();
  command.add_option("--frames", options->frames, "Number of frames")->capture_default_str();
  command.add_option("--disparities", config.disparities, "Disparity range that the depths fill")
      ->capture_default_str();
  command.add_option("--disparity-offset", config.disparity_offset, "Smallest disparity")
      ->capture_default_str();
  add_seed_option(command, config.seed, "Seed of textures, placement and noise");
  command.add_option("--read-noise", config.read_noise, "Constant noise, grey levels")->capture_default_str();
  command.add_option("--shot-noise", config.shot_noise, "Variance per grey level of signal")
      ->capture_default_str();
  command.add_option("--vignetting", config.vignetting, "Share of light lost in the corners")
      ->capture_default_str();
  command.add_option("--motion", config.motion, "Amplitude of the motion, 0 = none")->capture_default_str();
  command.add_flag("--rectified", options->rectified,
                   "No lens distortion, cameras aligned: nothing to rectify");
  command.callback([options, &context] { context.action = [options] { return write_scene(*options); }; });
}

}  // namespace parallax
