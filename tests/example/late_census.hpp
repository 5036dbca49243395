// SPDX-License-Identifier: Apache-2.0
// The census stage once more: as a stage of one's own that takes longer.
#pragma once

#include <systemc>

#include "modules/census.hpp"
#include "modules/raster_schedule.hpp"
#include "tlm/stage.hpp"

namespace parallax {

/// The same codes out of a deeper pipeline, or with a longer look-ahead.
class LateCensus final : public Stage {
 public:
  StreamIn<Gray> in_left{"in_left"};
  StreamIn<Gray> in_right{"in_right"};
  StreamOut<CensusCode> out_left{"out_left"};
  StreamOut<CensusCode> out_right{"out_right"};

  /// `more_rows`: that it looks ahead beyond the window, which then ends with the row.
  LateCensus(const sc_core::sc_module_name& name, const CensusConfig& config, std::uint32_t latency,
             const StageContext& context, int more_rows = 0)
      : Stage(name, context.clock, context.dataflow, latency),
        left_(config, context.width, context.height),
        right_(config, context.width, context.height),
        look_ahead_(look_ahead_tokens(context, left_.look_ahead_rows() + more_rows,
                                      more_rows > 0 ? 0 : left_.look_ahead_pixels())) {
    RasterSchedule raster;
    raster.reads.every = raster.writes.every = 0b11;
    raster.look_ahead = look_ahead_;
    set_schedule(make_schedule(context, raster));
    const auto width = static_cast<std::size_t>(context.width);
    in_left.on_row(width, [this, width](const Gray* row, std::size_t) {
      left_.push(row, [this, width](const CensusCode* out) { out_left.send_row(out, width); });
    });
    in_right.on_row(width, [this, width](const Gray* row, std::size_t) {
      right_.push(row, [this, width](const CensusCode* out) { out_right.send_row(out, width); });
    });
  }

  std::uint64_t look_ahead() const { return look_ahead_; }

 private:
  Census left_;
  Census right_;
  std::uint64_t look_ahead_;
};

}  // namespace parallax
