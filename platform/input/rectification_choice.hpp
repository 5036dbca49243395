// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

#include "modules/map_codec.hpp"
#include "platform/input/frame_source.hpp"
#include "platform/input/run_options.hpp"

namespace parallax {

/// How the images of a run are rectified.
struct RectificationChoice {
  EncodedMap map;                ///< of the padded size
  std::optional<cv::Matx44d> q;  ///< disparity to depth, when the calibration is known
};

/// From --map, --calibration with --fit, the calibration that comes with the images, or none: then the pair
/// counts as rectified and streams an identity map. `processed` is the size with padding, whose offsets
/// repeat the last column's and row's. Throws UserError when the map does not fit the images or the
/// configured window.
RectificationChoice choose_rectification(const RunOptions& options, const OffsetRange& range,
                                         const FrameSource& source, const cv::Size& processed,
                                         const NoticeSink& notice);

}  // namespace parallax
