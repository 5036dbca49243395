// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "platform/frame.hpp"
#include "platform/results/output_folder.hpp"
#include "platform/results/result_images.hpp"

namespace parallax {

/// How the results of a frame are written.
struct FrameResultOptions {
  ColorRange colors;
  std::optional<cv::Matx44d> q;  ///< for the point cloud; none: no point cloud
};

/// Adds the files of one frame to `folder`, under `prefix` ("" or "frame_0000/"); the caller publishes them:
/// disparity.png, disparity_color.png, causes.png, cause_labels.png, left_rectified.png, disparity.bin,
/// points.ply.
void write_frame(OutputFolder& folder, const std::string& prefix, const cv::Mat& left,
                 const std::vector<Disparity>& disparities, const FrameResultOptions& options);

}  // namespace parallax
