// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <utility>
#include <vector>

#include "modules/output_packing.hpp"
#include "modules/pixel.hpp"
#include "platform/machine/frame.hpp"
#include "platform/machine/machine_input.hpp"
#include "platform/machine/tile_plan.hpp"
#include "tlm/row_collector.hpp"
#include "tlm/stream.hpp"

namespace parallax {

/// The host: takes the frames that come over the link, compares the disparities in their bytes with those
/// that left the pipeline, and hands them on with the causes of the invalid ones, which the bytes do not
/// carry.
class Host final : public RowListener<Disparity> {
 public:
  /// `input` and `tiles` must outlive the object. `ended` says, after input.least_frames, whether the run
  /// can end.
  Host(const MachineInput& input, const TilePlan& tiles, OutputLeft left, std::function<bool()> ended)
      : input_(input), tiles_(tiles), left_(left), ended_(std::move(ended)), disparity_rows_(tiles.width) {}

  /// The pipeline's next row of disparities, `tiles.width` px: of a frame, tile by tile, row by row.
  void expect(const Disparity* row);
  /// The same, as the stream out of the pipeline carries them.
  void row(const StreamBase&, const Disparity* values, std::size_t size) override {
    disparity_rows_.push(values, size, [this](const Disparity* row, std::size_t) { expect(row); });
  }
  /// The frame is here, with its bytes (none without values). SC_REPORT_ERROR /parallax/machine/values when
  /// these hold other disparities than the pipeline's. After the last frame the run is over.
  void receive(std::int64_t frame, const std::vector<std::uint8_t>& bytes);
  /// Frames received.
  std::int64_t frames() const { return frames_; }
  /// It has the last one.
  bool done() const { return done_; }

 private:
  FrameResult unpack(std::int64_t frame, const std::vector<std::uint8_t>& bytes);

  const MachineInput& input_;
  const TilePlan& tiles_;
  const OutputLeft left_;
  const std::function<bool()> ended_;
  RowCollector<Disparity> disparity_rows_;
  std::deque<std::vector<Disparity>> expected_;  // frames that have left the pipeline and are not here
  std::vector<Disparity> leaving_;               // of the frame that is leaving it
  std::size_t rows_ = 0;                         // of this one, of all its tiles
  std::int64_t frames_ = 0;
  bool done_ = false;
};

}  // namespace parallax
