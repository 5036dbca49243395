// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "platform/commands/run_images.hpp"
#include "platform/machine/frame.hpp"
#include "platform/results/frame_results.hpp"
#include "platform/results/run_metrics.hpp"
#include "platform/results/strip_gif.hpp"

namespace parallax {

/// What comes out of the machine, frame by frame: counted, compared with the ground truth, and written.
class RunFrames {
 public:
  /// `folder`: null, if nothing is to be written.
  RunFrames(const RunImages& images, OutputFolder* folder, FrameResultOptions options)
      : images_(images), folder_(folder), options_(std::move(options)) {}

  /// A sequence's frame is published at once; the results of a single pair appear together with its timing.
  void take(const FrameResult& result);
  /// What was added up over the frames until now; `frames`, `pixels`, `valid` and the score.
  const RunTotals& totals() const { return totals_; }
  /// A sequence's moving picture appears when `publish` has published what else there is.
  template <class Publish>
  void publish_strip_with(const Publish& publish) {
    if (strip_) strip_->complete();
    publish();
    if (strip_) strip_->publish();
  }

 private:
  void write(const FrameResult& result, FrameImages frame);

  const RunImages& images_;
  OutputFolder* const folder_;
  const FrameResultOptions options_;
  RunTotals totals_;
  std::unique_ptr<StripGif> strip_;  ///< of a sequence
};

}  // namespace parallax
