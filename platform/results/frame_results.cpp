// SPDX-License-Identifier: Apache-2.0
#include "platform/results/frame_results.hpp"

#include <opencv2/imgproc.hpp>

#include "platform/images/image_codecs.hpp"
#include "platform/results/disparity_bin.hpp"
#include "platform/results/point_cloud.hpp"
#include "platform/results/result_images.hpp"

namespace parallax {

void write_frame(OutputFolder& folder, const std::string& prefix, const FrameImages& frame,
                 const FrameResultOptions& options) {
  const DisparityView view(frame.disparities, frame.left.cols, frame.left.rows);
  const auto write_png = [&](const char* name, const cv::Mat& image) {
    folder.write(prefix + name, encode_image(".png", image));
  };
  const cv::Mat colors = disparity_colors(view, options.colors);
  const Legend legend = disparity_legend(options.colors);
  cv::Mat left;
  cv::cvtColor(frame.left, left, cv::COLOR_GRAY2BGR);
  write_png("disparity.png", disparity_values(view));
  write_png("disparity_color.png", with_legend(colors, legend));
  write_png("causes.png", with_legend(cause_colors(view), cause_legend()));
  write_png("cause_labels.png", cause_labels(view));
  write_png("left_rectified.png", frame.left);
  write_png("side_by_side.png", side_by_side(left, "rectified left", colors, "disparity", legend));
  if (frame.truth) write_png("error.png", with_legend(error_colors(view, *frame.truth), error_legend()));
  folder.write(prefix + "disparity.bin", pack_disparities(view));
  if (options.q) folder.write(prefix + "points.ply", encode_point_cloud_ply(view, frame.left, *options.q));
}

}  // namespace parallax
