// SPDX-License-Identifier: Apache-2.0
#include "platform/input/run_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "platform/input/image_padding.hpp"
#include "platform/input/image_pairs.hpp"
#include "platform/machine/tile_plan.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr std::int64_t kMostFrames = 1'000'000'000;

std::unique_ptr<FrameSource> scene(const RunOptions& options, const MachineConfig& config) {
  SceneConfig scene_config = options.scene;
  if (config.image.width != 0) scene_config.width = config.image.width;
  if (config.image.height != 0) scene_config.height = config.image.height;
  if (!options.size.empty()) {
    if (config.image.width != 0 || config.image.height != 0) {
      throw UserError(
          "--size and image.width or image.height exclude each other: both say how large the scene is");
    }
    char rest = 0;
    if (std::sscanf(options.size.c_str(), "%5dx%5d%c", &scene_config.width, &scene_config.height, &rest) !=
        2) {
      throw UserError(fmt::format("--size: '{}' is not a size such as 640x480", excerpt(options.size)));
    }
  }
  const ImageLimits most = largest_images(config);
  // The tiles say with their arithmetic why a scene is too wide for them.
  if (config.image.max_width == 0) {
    plan_tiles(config.tiles, config.matching.range(),
               padded_size({scene_config.width, 1}, config.image.granularity()).width,
               config.timing.pixels_per_token);
  }
  if (scene_config.width > most.width || scene_config.height > most.height) {
    throw UserError(
        fmt::format("the built-in scene would be {}x{}, larger than the largest size {}x{} (image.max_width, "
                    "image.max_height)",
                    scene_config.width, scene_config.height, most.width, most.height));
  }
  scene_config.disparities = config.matching.range().count;
  scene_config.disparity_offset = config.matching.disparity_offset;
  scene_config.distortion = !options.rectified;
  scene_config.validate();
  return scene_source(scene_config, options.frames.value_or(1));
}

// At most as many as are asked for.
std::vector<ImagePair> pairs_of(const RunOptions& options) {
  std::vector<ImagePair> pairs;
  if (!options.images.empty()) {
    pairs = pairs_in_memory(options.images);
  } else if (!options.input.empty()) {
    pairs = find_image_pairs(options.input);
  } else {
    pairs = {{options.left, options.right}};
  }
  pairs.resize(std::min<std::size_t>(pairs.size(), options.frames.value_or(kMostFrames)));
  return pairs;
}

// What computes no images has no use for what is about them.
void check_timing_only(const RunOptions& options) {
  if (!options.timing_only) {
    if (!options.vary.empty()) throw UserError("--vary needs --timing-only");
    if (options.relax) throw UserError("--relax needs --timing-only");
    return;
  }
  if (options.relax && options.timing_frames.value_or(2) < 2 && options.frames.value_or(1) < 2) {
    throw UserError(
        "--relax compares frame rates, and one frame has none: --timing-frames must be at least 2");
  }
  const auto refuse = [](const char* option, bool given) {
    if (given) throw UserError(fmt::format("--timing-only computes no images: it cannot go with {}", option));
  };
  refuse("--ground-truth", !options.ground_truth.empty());
  refuse("--mask", !options.mask.empty());
  refuse("--image-bits", options.image_bits.has_value());
  refuse("--no-point-cloud", !options.point_cloud);
}

// A trace is a file of one run's.
void check_trace(const RunOptions& options) {
  const TraceOptions& trace = options.trace;
  if (!trace.wanted()) {
    const char* const alone = !trace.level.empty()   ? "--trace-level"
                              : !trace.from.empty()  ? "--trace-from"
                              : !trace.to.empty()    ? "--trace-to"
                              : !trace.parts.empty() ? "--trace-parts"
                                                     : nullptr;
    if (alone != nullptr)
      throw UserError(fmt::format("{} says what of a trace is wanted: it needs --trace", alone));
    return;
  }
  if (options.out.empty()) throw UserError("--trace needs --out: the folder that the trace is written to");
  if (options.relax || !options.vary.empty()) {
    throw UserError(
        fmt::format("--trace is of one run: it cannot go with {}", options.relax ? "--relax" : "--vary"));
  }
}

void check_report(const RunOptions& options) {
  if (!options.report) return;
  if (options.out.empty()) throw UserError("--report needs --out: the folder that report.html is written to");
  if (options.relax || !options.vary.empty()) {
    throw UserError(
        fmt::format("--report is of one run: it cannot go with {}", options.relax ? "--relax" : "--vary"));
  }
  if (!options.verdict)
    throw UserError("--report and --no-verdict exclude each other: it says what each limit costs");
}

// A circuit works on values, and a machine without it says nothing of it.
void check_circuit(const RunOptions& options) {
  if (options.circuits.empty()) return;
  const char* const other = options.timing_only ? "--timing-only" : options.report ? "--report" : nullptr;
  if (other != nullptr) throw UserError(fmt::format("--circuit and {} exclude each other", other));
  const bool waves = std::any_of(options.circuits.begin(), options.circuits.end(),
                                 [](const CircuitOptions& circuit) { return circuit.waves.has_value(); });
  if (waves && options.out.empty())
    throw UserError("--circuit-waves needs --out: the folder that the waves are written to");
}

}  // namespace

ImageLimits largest_images(const MachineConfig& config) {
  ImageLimits largest;
  largest.width = config.image.max_width != 0 ? static_cast<int>(config.image.max_width)
                                              : largest_width(config.tiles, config.matching.range());
  largest.height = static_cast<int>(config.image.max_height);
  return largest;
}

void check_options(const RunOptions& options) {
  check_timing_only(options);
  check_circuit(options);
  check_trace(options);
  check_report(options);
  if (options.left.empty() != options.right.empty()) {
    throw UserError(fmt::format("{} is missing: a pair needs --left and --right",
                                options.left.empty() ? "--left" : "--right"));
  }
  if ((!options.left.empty() || !options.images.empty()) && !options.input.empty())
    throw UserError("--input and --left/--right exclude each other");
  const auto count = [](const char* option, std::int64_t value) {
    if (value >= 1 && value <= kMostFrames) return;
    throw UserError(fmt::format("{} is {}, allowed is 1 to {}", option, value, kMostFrames));
  };
  count("--frames", options.frames.value_or(1));
  count("--timing-frames", options.timing_frames.value_or(1));
  if (!options.mask.empty() && options.ground_truth.empty()) throw UserError("--mask needs --ground-truth");
  if (options.ground_truth_scale && options.ground_truth.empty())
    throw UserError("--ground-truth-scale needs --ground-truth");
  if (!options.ground_truth_encoding.empty() && options.ground_truth.empty())
    throw UserError("--ground-truth-encoding needs --ground-truth");
  if (truth_encoding(options.ground_truth_encoding) != TruthEncoding::kValues && options.ground_truth_scale)
    throw UserError(
        "--ground-truth-encoding sintel and --ground-truth-scale exclude each other: Sintel's are in pixels");
  if (options.image_bits && (*options.image_bits < 8 || *options.image_bits > 16))
    throw UserError(fmt::format("--image-bits is {}, allowed is 8 to 16", *options.image_bits));
  if (options.fit && options.calibration.empty()) throw UserError("--fit needs --calibration");
  if (!options.cameras.empty() && options.calibration.empty())
    throw UserError("--cameras needs --calibration");
  if (!options.map.empty() && !options.calibration.empty()) {
    throw UserError("--map and --calibration exclude each other: both say how to rectify");
  }
  if (options.is_scene()) {
    if (options.image_bits) throw UserError("--image-bits is for 16-bit images, but none are given");
    if (options.ground_truth.empty()) return;
    throw UserError(
        "--ground-truth and --mask go with --left and --right; the built-in scene brings its own");
  }
  if (!options.size.empty() || options.rectified) {
    throw UserError("--size and --rectified are for the built-in scene, but images are given");
  }
  if (options.scene.seed != SceneConfig{}.seed) {
    throw UserError("--seed is for the built-in scene, but images are given");
  }
}

std::unique_ptr<FrameSource> open_source(const RunOptions& options, const MachineConfig& config,
                                         const NoticeSink& notice) {
  if (options.is_scene()) return scene(options, config);
  ImageChoice choice;
  choice.limits = largest_images(config);
  choice.bits = options.image_bits;
  choice.first_only = options.timing_only;
  auto source = file_source(pairs_of(options), choice,
                            {options.ground_truth, options.mask, options.ground_truth_scale,
                             truth_encoding(options.ground_truth_encoding)},
                            notice);
  const auto demand = [&](const char* key, int wanted, int found) {
    if (wanted != 0 && wanted != found) {
      throw UserError(fmt::format("{} = {}, but {} has {} px; 0 takes it from the images", key, wanted,
                                  source->name(), found));
    }
  };
  demand("image.width", config.image.width, source->width());
  demand("image.height", config.image.height, source->height());
  return source;
}

}  // namespace parallax
