// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <systemc>

#include "modules/frame_changes.hpp"
#include "modules/raster_schedule.hpp"
#include "modules/subpixel.hpp"
#include "tlm/stage.hpp"

namespace parallax {

/// Winner takes all and subpixel optimization: the cost groups of a pixel in, its disparity out with the last
/// one (subpixel.hpp; paper, "Subpixel Optimization").
class SubpixelStage final : public Stage {
 public:
  StreamIn<Cost> in_costs{"in_costs"};  ///< a token is one group of costs
  StreamOut<Disparity> out_disparity{"out_disparity"};

  SubpixelStage(const sc_core::sc_module_name& name, const SubpixelConfig& config, DisparityRange range,
                const CostGroups& groups, const StageTiming& timing, const StageContext& context);

  /// The configuration for the next frame that has none yet, or none: as before. What fixes the schedule
  /// must not change.
  void configure(const std::optional<SubpixelConfig>& config) { changes_.push(config); }
  Bits storage() const { return storage_; }

 private:
  std::optional<Subpixel> kernel_;
  FrameChanges<SubpixelConfig> changes_;
  Bits storage_;
};

}  // namespace parallax
