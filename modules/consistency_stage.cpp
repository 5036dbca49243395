// SPDX-License-Identifier: Apache-2.0
#include "modules/consistency_stage.hpp"

namespace parallax {

ConsistencyStage::ConsistencyStage(const sc_core::sc_module_name& name, const ConsistencyConfig& config,
                                   DisparityRange range, std::uint32_t groups, const StageTiming& timing,
                                   const StageContext& context)
    : Stage(name, context.clock, context.dataflow, timing.latency),
      kernel_(config, range, context.width, context.height),
      rows_(static_cast<std::size_t>(context.width) * static_cast<std::size_t>(range.count),
            static_cast<std::size_t>(context.width),
            [this, width = static_cast<std::size_t>(context.width)](const Cost* costs,
                                                                    const Disparity* disparities) {
              kernel_.push(costs, disparities,
                           [this, width](const Disparity* out) { out_disparity.send_row(out, width); });
            }),
      look_ahead_(look_ahead_pixels(context, kernel_.look_ahead_rows(), kernel_.look_ahead_pixels())) {
  const auto width = static_cast<std::size_t>(context.width);
  RasterSchedule raster;
  raster.beats = groups;
  raster.reads.every = 0b01;
  raster.reads.last = 0b10;
  raster.writes.last = 0b1;
  raster.look_ahead = look_ahead_;
  raster.timing = timing;
  set_schedule(make_schedule(context, raster));
  in_costs.on_row(width * static_cast<std::size_t>(range.count),
                  [this](const Cost* row, std::size_t) { rows_.push_a(row); });
  in_disparity.on_row(width, [this](const Disparity* row, std::size_t) { rows_.push_b(row); });
}

}  // namespace parallax
