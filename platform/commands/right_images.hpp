// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <opencv2/core/mat.hpp>

#include "modules/pixel.hpp"
#include "platform/machine/machine.hpp"
#include "tlm/row_collector.hpp"
#include "tlm/stream.hpp"

namespace parallax {

/// The rectified right images as they leave the rectification, which the machine does not send to the host.
/// Made before the simulation starts.
class RightImages final : public RowListener<Gray> {
 public:
  explicit RightImages(const Machine& machine);

  void row(const StreamBase&, const Gray* values, std::size_t size) override;
  /// Of the next frame with images, when the host has it: of the size that is processed.
  cv::Mat take();

 private:
  void keep(const Gray* row);

  const TilePlan& tiles_;
  const cv::Size size_;
  RowCollector<Gray> rows_;
  std::size_t kept_ = 0;  // rows of the frame that comes, of all its tiles
  cv::Mat coming_;
  std::deque<cv::Mat> whole_;
};

}  // namespace parallax
