// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "modules/pixel.hpp"
#include "modules/raster_schedule.hpp"
#include "tlm/stage.hpp"

namespace parallax {

/// A filter of the disparity map: one disparity in, one out, as much later as the kernel looks ahead.
/// Interval and latency are configured; storage is the kernel's.
template <class Kernel, class Config>
class DisparityFilterStage final : public Stage {
 public:
  StreamIn<Disparity> in_disparity{"in_disparity"};
  StreamOut<Disparity> out_disparity{"out_disparity"};

  DisparityFilterStage(const sc_core::sc_module_name& name, const Config& config, const StageTiming& timing,
                       const StageContext& context)
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

  std::uint64_t look_ahead() const { return look_ahead_; }
  Bits storage() const { return Bits(kernel_.storage_bits()); }

 private:
  Kernel kernel_;
  std::uint64_t look_ahead_;
};

}  // namespace parallax
