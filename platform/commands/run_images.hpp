// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "platform/config/machine_config.hpp"
#include "platform/input/frame_source.hpp"
#include "platform/input/image_padding.hpp"
#include "platform/input/rectification_choice.hpp"
#include "platform/input/run_options.hpp"
#include "platform/machine/frame.hpp"

namespace parallax {

/// The images of a run as the machine takes them: padded to a size that it can process.
class RunImages {
 public:
  /// Throws UserError when they cannot be read, or the configuration does not go with them. `notice` hears of
  /// what is done to them, also later.
  RunImages(const RunOptions& options, const MachineConfig& config, const NoticeSink& notice);

  std::int64_t frames() const { return source_->frames(); }
  bool is_scene() const { return is_scene_; }
  const cv::Size& size() const { return size_; }
  const cv::Size& padded() const { return padded_; }
  const EncodedMap& map() const { return rectification_.map; }
  /// Disparity to depth, when the calibration is known.
  const std::optional<cv::Matx44d>& q() const { return rectification_.q; }

  StereoFrame load(std::int64_t frame) const;
  std::optional<GroundTruth> truth(std::int64_t frame) const { return source_->truth(frame); }

 private:
  const bool is_scene_;
  const std::unique_ptr<FrameSource> source_;
  const Granularity granularity_;
  const cv::Size size_;
  const cv::Size padded_;
  const RectificationChoice rectification_;
};

}  // namespace parallax
