// SPDX-License-Identifier: Apache-2.0
#include "modules/texture_stage.hpp"

namespace parallax {

TextureStage::TextureStage(const sc_core::sc_module_name& name, const TextureConfig& config,
                           const StageTiming& timing, const StageContext& context)
    : Stage(name, context.clock, context.dataflow, timing.latency),
      kernel_(config, context.width, context.height),
      changes_(context.height),
      look_ahead_(look_ahead_tokens(context, kernel_.look_ahead_rows(), kernel_.look_ahead_pixels())),
      storage_(kernel_.storage_bits(context.pixels_per_token)) {
  const std::size_t width = context.width;
  RasterSchedule raster;
  raster.reads.every = 0b01;
  raster.reads_late.every = 0b10;
  raster.writes.every = 0b1;
  raster.look_ahead = look_ahead_;
  raster.timing = timing;
  set_schedule(make_schedule(context, raster));
  const RowSink<Disparity> emit = [this, width](const Disparity* out) { out_disparity.send_row(out, width); };
  in_left.on_row(width, [this, emit](const Gray* row, std::size_t) {
    if (const auto change = changes_.at_row()) kernel_.set_threshold(change->enabled ? change->threshold : 0);
    kernel_.push_image(row, emit);
  });
  in_disparity.on_row(width,
                      [this, emit](const Disparity* row, std::size_t) { kernel_.push_disparity(row, emit); });
}

}  // namespace parallax
