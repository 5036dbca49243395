// SPDX-License-Identifier: Apache-2.0
#include "platform/results/frame_results.hpp"

#include "platform/results/disparity_bin.hpp"
#include "platform/results/point_cloud.hpp"

namespace parallax {

void write_frame(OutputFolder& folder, const std::string& prefix, const cv::Mat& left,
                 const std::vector<Disparity>& disparities, const FrameResultOptions& options) {
  const DisparityView view(disparities, left.cols, left.rows);
  folder.write(prefix + "disparity.png", encode_disparity_png(view));
  folder.write(prefix + "disparity_color.png", encode_disparity_color_png(view, options.colors));
  folder.write(prefix + "causes.png", encode_causes_png(view));
  folder.write(prefix + "cause_labels.png", encode_cause_labels_png(view));
  folder.write(prefix + "left_rectified.png", encode_png(left));
  folder.write(prefix + "disparity.bin", pack_disparities(view));
  if (options.q) folder.write(prefix + "points.ply", encode_point_cloud_ply(view, left, *options.q));
}

}  // namespace parallax
