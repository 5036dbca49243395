// SPDX-License-Identifier: Apache-2.0
#include "modules/subpixel_stage.hpp"

#include <utility>

namespace parallax {

SubpixelStage::SubpixelStage(const sc_core::sc_module_name& name, const SubpixelConfig& config,
                             DisparityRange range, const CostGroups& groups, const StageTiming& timing,
                             const StageContext& context)
    : Stage(name, context.clock, context.dataflow, timing.latency),
      kernel_(std::in_place, config, range, context.width, context.height),
      changes_(context.height),
      storage_(kernel_->storage_bits(groups.rows)) {
  const std::size_t width = context.width;
  RasterSchedule raster;
  raster.groups = groups.of_token;
  raster.reads.every = 0b1;
  raster.writes.last = 0b1;
  raster.timing = timing;
  set_schedule(make_schedule(context, raster));
  in_costs.on_row(width * range.count, [this, width, range, context](const Cost* row, std::size_t) {
    if (const auto change = changes_.at_row()) kernel_.emplace(*change, range, context.width, context.height);
    kernel_->push(row, [this, width](const Disparity* out) { out_disparity.send_row(out, width); });
  });
}

}  // namespace parallax
