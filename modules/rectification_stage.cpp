// SPDX-License-Identifier: Apache-2.0
#include "modules/rectification_stage.hpp"

namespace parallax {

RectificationStage::RectificationStage(const sc_core::sc_module_name& name, const RectificationConfig& config,
                                       const StageTiming& timing, const StageContext& context)
    : Stage(name, context.clock, context.dataflow, timing.latency),
      kernel_(config, context.width, context.height),
      emit_([this, width = static_cast<std::size_t>(context.width)](const Gray* left, const Gray* right) {
        out_left.send_row(left, width);
        out_right.send_row(right, width);
      }),
      images_(context.width, context.width,
              [this, width = context.width](const Gray* left, const Gray* right) {
                waiting_.emplace_back(left, left + width);
                waiting_.emplace_back(right, right + width);
                push_waiting_images();
              }),
      look_ahead_(look_ahead_tokens(context, kernel_.look_ahead_rows(), kernel_.look_ahead_pixels())) {
  const std::size_t width = context.width;
  RasterSchedule raster;
  raster.reads.every = 0b011;
  raster.reads_late.every = 0b100;
  raster.writes.every = 0b11;
  raster.look_ahead = look_ahead_;
  raster.timing = timing;
  set_schedule(make_schedule(context, raster));
  in_left.on_row(width, [this](const Gray* row, std::size_t) { images_.push_a(row); });
  in_right.on_row(width, [this](const Gray* row, std::size_t) { images_.push_b(row); });
  in_map.on_row(width, [this](const OffsetPair* row, std::size_t) {
    kernel_.push_map(row, emit_);
    push_waiting_images();
  });
}

void RectificationStage::push_waiting_images() {
  while (!waiting_.empty() && kernel_.can_push_images()) {
    const std::vector<Gray> left = std::move(waiting_[0]);
    const std::vector<Gray> right = std::move(waiting_[1]);
    waiting_.erase(waiting_.begin(), waiting_.begin() + 2);
    kernel_.push_images(left.data(), right.data(), emit_);
  }
}

}  // namespace parallax
