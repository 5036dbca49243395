// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "modules/gap_interpolation.hpp"
#include "modules/raster_schedule.hpp"
#include "tlm/stage.hpp"

namespace parallax {

/// Gap interpolation: one disparity in, one out; looks ahead l_max rows (gap_interpolation.hpp).
class GapInterpolationStage final : public Stage {
 public:
  StreamIn<Disparity> in_disparity{"in_disparity"};
  StreamOut<Disparity> out_disparity{"out_disparity"};

  GapInterpolationStage(const sc_core::sc_module_name& name, const GapInterpolationConfig& config,
                        const StageTiming& timing, const StageContext& context);

  std::uint64_t look_ahead() const { return look_ahead_; }
  Bits storage() const { return Bits(kernel_.storage_bits()); }

 private:
  GapInterpolation kernel_;
  std::uint64_t look_ahead_;
};

}  // namespace parallax
