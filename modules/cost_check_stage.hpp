// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <systemc>
#include <utility>

#include "modules/area.hpp"
#include "modules/frame_changes.hpp"
#include "modules/pixel.hpp"
#include "modules/raster_schedule.hpp"
#include "modules/row_join.hpp"
#include "modules/winner.hpp"
#include "tlm/stage.hpp"

namespace parallax {

/// A check of disparities against their costs: the cost groups of a pixel and, with the last one, its
/// disparity in; the disparity out, as much later as the kernel looks ahead. With several pixels a token, or
/// parallel rows in the matcher, it is the groups of a token and its disparities (CostGroups). Interval (a
/// group) and latency are configured; storage is the kernel's.
template <class Kernel, class Config>
class CostCheckStage final : public Stage {
 public:
  StreamIn<Cost> in_costs{"in_costs"};  ///< a token is one group of costs
  StreamIn<Disparity> in_disparity{"in_disparity"};
  StreamOut<Disparity> out_disparity{"out_disparity"};

  CostCheckStage(const sc_core::sc_module_name& name, const Config& config, DisparityRange range,
                 const CostGroups& groups, const StageTiming& timing, const StageContext& context)
      : Stage(name, context.clock, context.dataflow, timing.latency),
        kernel_(std::in_place, config, range, context.width, context.height),
        changes_(context.height),
        rows_(area(context.width, range.count), context.width,
              [this, range, context, width = static_cast<std::size_t>(context.width)](
                  const Cost* costs, const Disparity* disparities) {
                if (const auto change = changes_.at_row()) {
                  kernel_.emplace(*change, range, context.width, context.height);
                }
                kernel_->push(costs, disparities,
                              [this, width](const Disparity* out) { out_disparity.send_row(out, width); });
              }),
        look_ahead_(look_ahead_tokens(context, kernel_->look_ahead_rows(),
                                      groups.rows * kernel_->look_ahead_pixels())),
        storage_(kernel_->storage_bits(groups.rows)) {
    const std::size_t width = context.width;
    RasterSchedule raster;
    raster.groups = groups.of_token;
    raster.reads.every = 0b01;
    raster.reads.last = 0b10;
    raster.writes.last = 0b1;
    raster.look_ahead = look_ahead_;
    raster.timing = timing;
    set_schedule(make_schedule(context, raster));
    in_costs.on_row(width * range.count, [this](const Cost* row, std::size_t) { rows_.push_a(row); });
    in_disparity.on_row(width, [this](const Disparity* row, std::size_t) { rows_.push_b(row); });
  }

  /// The configuration for the next frame that has none yet, or none: as before. What fixes the schedule
  /// must not change.
  void configure(const std::optional<Config>& config) { changes_.push(config); }
  std::uint64_t look_ahead() const { return look_ahead_; }
  Bits storage() const { return storage_; }

 private:
  std::optional<Kernel> kernel_;
  FrameChanges<Config> changes_;
  RowJoin<Cost, Disparity> rows_;
  std::uint64_t look_ahead_;
  Bits storage_;
};

}  // namespace parallax
