// SPDX-License-Identifier: Apache-2.0
#include "modules/speckle_stage.hpp"

namespace parallax {

SpeckleStage::SpeckleStage(const sc_core::sc_module_name& name, const SpeckleConfig& config,
                           const StageTiming& timing, const StageContext& context)
    : Stage(name, context.clock, context.dataflow, timing.latency),
      kernel_(config, context.width, context.height),
      look_ahead_(look_ahead_pixels(context, kernel_.look_ahead_rows(), kernel_.look_ahead_pixels())) {
  const auto width = static_cast<std::size_t>(context.width);
  RasterSchedule raster;
  raster.reads.every = 0b1;
  raster.writes.every = 0b1;
  raster.look_ahead = look_ahead_;
  raster.timing = timing;
  set_schedule(make_schedule(context, raster));
  in_disparity.on_row(width, [this, width](const Disparity* row, std::size_t) {
    kernel_.push(row, [this, width](const Disparity* out) { out_disparity.send_row(out, width); });
  });
}

}  // namespace parallax
