// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "modules/raster_schedule.hpp"
#include "modules/speckle.hpp"
#include "tlm/stage.hpp"

namespace parallax {

/// Speckle filter: one disparity in, one out; half a window of look-ahead for each pass (speckle.hpp).
class SpeckleStage final : public Stage {
 public:
  StreamIn<Disparity> in_disparity{"in_disparity"};
  StreamOut<Disparity> out_disparity{"out_disparity"};

  SpeckleStage(const sc_core::sc_module_name& name, const SpeckleConfig& config, const StageTiming& timing,
               const StageContext& context);

  std::uint64_t look_ahead() const { return look_ahead_; }
  Bits storage() const { return Bits(kernel_.storage_bits()); }

 private:
  Speckle kernel_;
  std::uint64_t look_ahead_;
};

}  // namespace parallax
