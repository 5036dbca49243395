// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "platform/config/configuration.hpp"
#include "platform/input/circuit_options.hpp"
#include "platform/scene/scene_config.hpp"
#include "platform/scene/stereo_images.hpp"
#include "platform/tracing/trace_options.hpp"

namespace parallax {

struct FrameImages;

/// What the user asked `parallax run` for.
struct RunOptions {
  ConfigurationRequest configuration;
  // Input: a pair, a folder or list, or else the built-in scene.
  std::string left;
  std::string right;
  std::string input;
  std::vector<StereoImages> images;  ///< pairs in memory instead, of the pixels that a file may have
  std::string size;                  ///< WxH of the built-in scene
  SceneConfig scene;
  bool rectified = false;                     ///< the built-in scene without distortion
  std::optional<std::int64_t> frames;         ///< none: all of the input; one of the scene
  std::optional<std::int64_t> timing_frames;  ///< none: the warm-up and three more
  std::optional<int> image_bits;              ///< of the values in 16-bit images; none: by the largest
  std::string ground_truth;
  std::optional<double> ground_truth_scale;  ///< disparity = value / scale; none: by the pixel format
  std::string ground_truth_encoding;         ///< "sintel"; empty: values
  std::string mask;
  // Rectification.
  std::vector<std::string> calibration;
  std::string cameras;  ///< "2,3": of a calibration with several
  std::string map;
  bool fit = false;
  std::vector<CircuitOptions> circuits;  ///< each in the place of another stage
  bool circuit_shadow = false;           ///< they run beside the model, and nothing of theirs flows on
  // Output.
  bool timing_only = false;       ///< no images are computed
  std::vector<std::string> vary;  ///< "key=v1,v2,...": a grid of timing-only runs
  bool verdict = true;            ///< what limits is found by running without it
  bool relax = false;             ///< timing-only runs with one limit at a time taken away
  std::filesystem::path out;
  TraceOptions trace;   ///< goes into `out`
  bool report = false;  ///< a page of HTML in `out`, with what taking away each limit gains
  bool point_cloud = true;
  bool json = false;
  /// Hears of each frame with images, where a program takes them from memory.
  std::function<void(std::int64_t frame, const FrameImages& result)> take;

  /// Whether the built-in scene is the input.
  bool is_scene() const { return left.empty() && input.empty() && images.empty(); }
};

}  // namespace parallax
