// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "platform/machine/frame.hpp"
#include "platform/results/color_scale.hpp"
#include "platform/results/ground_truth.hpp"
#include "platform/results/output_folder.hpp"

namespace parallax {

/// How the results of a frame are written.
struct FrameResultOptions {
  ColorScale colors;             ///< of disparities
  std::optional<cv::Matx44d> q;  ///< for the point cloud; none: no point cloud
};

/// What is written of a frame: images of one size.
struct FrameImages {
  cv::Mat left;  ///< rectified, CV_8UC1
  std::vector<Disparity> disparities;
  std::optional<GroundTruth> truth;
  cv::Mat right{};  ///< rectified, which is not written and need not be there
};

/// Adds the files of one frame to `folder`, under `prefix` ("" or "frame_0000/"); the caller publishes them:
/// disparity.png, disparity_color.png, causes.png, cause_labels.png, left_rectified.png, side_by_side.png,
/// error.png (with ground truth), disparity.bin, points.ply.
void write_frame(OutputFolder& folder, const std::string& prefix, const FrameImages& frame,
                 const FrameResultOptions& options);

}  // namespace parallax
