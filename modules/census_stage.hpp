// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "modules/census.hpp"
#include "modules/raster_schedule.hpp"
#include "tlm/stage.hpp"

namespace parallax {

/// Pre-processing of both images: a rectified pixel pair in, a pair of census codes out, half a window later
/// (census.hpp; paper, "Image Pre-Processing").
class CensusStage final : public Stage {
 public:
  StreamIn<Gray> in_left{"in_left"};
  StreamIn<Gray> in_right{"in_right"};
  StreamOut<CensusCode> out_left{"out_left"};
  StreamOut<CensusCode> out_right{"out_right"};

  CensusStage(const sc_core::sc_module_name& name, const CensusConfig& config, const StageTiming& timing,
              const StageContext& context);

  std::uint64_t look_ahead() const { return look_ahead_; }
  Bits storage() const { return storage_; }

 private:
  Census left_;
  Census right_;
  std::uint64_t look_ahead_;
  Bits storage_;
};

}  // namespace parallax
