// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/run_images.hpp"

#include <string>
#include <vector>

#include "platform/input/run_input.hpp"

namespace parallax {

RunImages::RunImages(const RunOptions& options, const MachineConfig& config, const NoticeSink& notice)
    : is_scene_(options.is_scene()),
      source_(open_source(options, config, notice)),
      granularity_(config.image.granularity()),
      size_(source_->width(), source_->height()),
      padded_(padded_size(size_, granularity_)),
      rectification_(choose_rectification(options, config.rectification.range, *source_, padded_, notice)) {
  if (const std::string line = padding_notice(size_, granularity_); !line.empty()) notice(line);
}

StereoFrame RunImages::load(std::int64_t frame) const {
  const StereoImages images = pad_images(source_->load(frame), granularity_);
  const auto pixels = [](const cv::Mat& image) {
    return std::make_shared<const std::vector<Gray>>(image.begin<Gray>(), image.end<Gray>());
  };
  return {pixels(images.left), pixels(images.right)};
}

}  // namespace parallax
