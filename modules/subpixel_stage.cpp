// SPDX-License-Identifier: Apache-2.0
#include "modules/subpixel_stage.hpp"

namespace parallax {

SubpixelStage::SubpixelStage(const sc_core::sc_module_name& name, const SubpixelConfig& config,
                             DisparityRange range, std::uint32_t groups, const StageTiming& timing,
                             const StageContext& context)
    : Stage(name, context.clock, context.dataflow, timing.latency),
      kernel_(config, range, context.width, context.height) {
  const auto width = static_cast<std::size_t>(context.width);
  RasterSchedule raster;
  raster.beats = groups;
  raster.reads.every = 0b1;
  raster.writes.last = 0b1;
  raster.timing = timing;
  set_schedule(make_schedule(context, raster));
  in_costs.on_row(width * static_cast<std::size_t>(range.count), [this, width](const Cost* row, std::size_t) {
    kernel_.push(row, [this, width](const Disparity* out) { out_disparity.send_row(out, width); });
  });
}

}  // namespace parallax
