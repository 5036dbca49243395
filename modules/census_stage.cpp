// SPDX-License-Identifier: Apache-2.0
#include "modules/census_stage.hpp"

namespace parallax {

CensusStage::CensusStage(const sc_core::sc_module_name& name, const CensusConfig& config,
                         const StageTiming& timing, const StageContext& context)
    : Stage(name, context.clock, context.dataflow, timing.latency),
      left_(config, context.width, context.height),
      right_(config, context.width, context.height),
      look_ahead_(look_ahead_tokens(context, left_.look_ahead_rows(), left_.look_ahead_pixels())),
      storage_(left_.storage_bits(context.pixels_per_token) + right_.storage_bits(context.pixels_per_token)) {
  const std::size_t width = context.width;
  RasterSchedule raster;
  raster.reads.every = 0b11;
  raster.writes.every = 0b11;
  raster.look_ahead = look_ahead_;
  raster.timing = timing;
  set_schedule(make_schedule(context, raster));
  in_left.on_row(width, [this, width](const Gray* row, std::size_t) {
    left_.push(row, [this, width](const CensusCode* out) { out_left.send_row(out, width); });
  });
  in_right.on_row(width, [this, width](const Gray* row, std::size_t) {
    right_.push(row, [this, width](const CensusCode* out) { out_right.send_row(out, width); });
  });
}

}  // namespace parallax
