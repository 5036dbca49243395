// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "platform/input/calibration.hpp"
#include "platform/input/image_input.hpp"
#include "platform/results/truth_file.hpp"
#include "platform/scene/scene_config.hpp"

namespace parallax {

/// Where the stereo pairs of a run come from: files, or the built-in scene.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  virtual std::int64_t frames() const = 0;
  virtual int width() const = 0;   ///< px, of the images as they are
  virtual int height() const = 0;  ///< px
  /// What a reader of a message or a result calls it.
  virtual std::string name() const = 0;
  /// 8-bit mono images of one frame.
  virtual StereoImages load(std::int64_t frame) = 0;
  /// True disparities of one frame, if they are known.
  virtual std::optional<GroundTruth> truth(std::int64_t frame) = 0;
  /// The calibration that comes with the images, if one does.
  virtual std::optional<Calibration> calibration() const = 0;
};

/// `frames`: how many frames of the endless scene.
std::unique_ptr<FrameSource> scene_source(const SceneConfig& config, std::int64_t frames);

/// `truth`: its paths are empty for none; only for a single pair.
std::unique_ptr<FrameSource> file_source(std::vector<ImagePair> pairs, const ImageChoice& choice,
                                         const TruthFiles& truth, const NoticeSink& notice);

}  // namespace parallax
