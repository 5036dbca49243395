// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "modules/noise_reduction.hpp"
#include "modules/raster_schedule.hpp"
#include "tlm/stage.hpp"

namespace parallax {

/// Noise reduction: one disparity in, one out; half a window of look-ahead (noise_reduction.hpp).
class NoiseReductionStage final : public Stage {
 public:
  StreamIn<Disparity> in_disparity{"in_disparity"};
  StreamOut<Disparity> out_disparity{"out_disparity"};

  NoiseReductionStage(const sc_core::sc_module_name& name, const NoiseReductionConfig& config,
                      const StageTiming& timing, const StageContext& context);

  std::uint64_t look_ahead() const { return look_ahead_; }
  Bits storage() const { return Bits(kernel_.storage_bits()); }

 private:
  NoiseReduction kernel_;
  std::uint64_t look_ahead_;
};

}  // namespace parallax
