// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "modules/pixel.hpp"
#include "modules/raster_schedule.hpp"
#include "modules/row_join.hpp"
#include "modules/winner.hpp"
#include "tlm/stage.hpp"

namespace parallax {

/// A check of disparities against their costs: the cost groups of a pixel and, with the last one, its
/// disparity in; the disparity out, as much later as the kernel looks ahead. Interval (a group) and latency
/// are configured; storage is the kernel's.
template <class Kernel, class Config>
class CostCheckStage final : public Stage {
 public:
  StreamIn<Cost> in_costs{"in_costs"};  ///< a token is one group of costs
  StreamIn<Disparity> in_disparity{"in_disparity"};
  StreamOut<Disparity> out_disparity{"out_disparity"};

  /// `groups`: cost tokens a pixel.
  CostCheckStage(const sc_core::sc_module_name& name, const Config& config, DisparityRange range,
                 std::uint32_t groups, const StageTiming& timing, const StageContext& context)
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

  std::uint64_t look_ahead() const { return look_ahead_; }
  Bits storage() const { return Bits(kernel_.storage_bits()); }

 private:
  Kernel kernel_;
  RowJoin<Cost, Disparity> rows_;
  std::uint64_t look_ahead_;
};

}  // namespace parallax
