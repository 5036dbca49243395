// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

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

  /// `groups`: cost tokens a pixel.
  SubpixelStage(const sc_core::sc_module_name& name, const SubpixelConfig& config, DisparityRange range,
                std::uint32_t groups, const StageTiming& timing, const StageContext& context);

  Bits storage() const { return Bits(kernel_.storage_bits()); }

 private:
  Subpixel kernel_;
};

}  // namespace parallax
