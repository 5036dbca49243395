// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "platform/commands/run_images.hpp"
#include "platform/machine/frame.hpp"
#include "platform/results/frame_results.hpp"
#include "platform/results/run_metrics.hpp"
#include "platform/results/strip_gif.hpp"

namespace parallax {

/// What comes out of the machine, frame by frame: counted, compared with the ground truth, and written.
class RunFrames {
 public:
  /// Hears of each frame, to which it may add.
  using Listener = std::function<void(std::int64_t frame, FrameImages& result)>;

  /// `folder`: null, if nothing is to be written; `listener`: if nobody is to hear. `largest_disparity`: px,
  /// that the machine looks for.
  RunFrames(const RunImages& images, OutputFolder* folder, Listener listener, FrameResultOptions options,
            int largest_disparity)
      : images_(images),
        folder_(folder),
        listener_(std::move(listener)),
        options_(std::move(options)),
        largest_disparity_(largest_disparity) {}

  /// A sequence's frame is published at once; the results of a single pair appear together with its timing.
  void take(const FrameResult& result);
  /// What was added up over the frames until now; `frames`, `pixels`, `valid` and the score.
  const RunTotals& totals() const { return totals_; }
  /// What the results say of the input, a line each: sides that look exchanged, a truth of another scale.
  const std::vector<std::string>& remarks() const { return remarks_; }
  /// No frame follows: completes a sequence's moving picture, which the folder publishes with what else there
  /// is.
  void complete() {
    if (strip_) strip_->complete();
  }

 private:
  void write(std::int64_t index, const FrameImages& frame);
  void look_at_sides(std::int64_t frame);

  const RunImages& images_;
  OutputFolder* const folder_;
  const Listener listener_;
  const FrameResultOptions options_;
  const int largest_disparity_;
  RunTotals totals_;
  std::vector<std::string> remarks_;
  std::unique_ptr<StripGif> strip_;  ///< of a sequence
};

}  // namespace parallax
