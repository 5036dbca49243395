// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "modules/matching.hpp"
#include "modules/raster_schedule.hpp"
#include "modules/row_join.hpp"
#include "tlm/stage.hpp"

namespace parallax {

/// Semi-global matching: a pair of census codes in, n_i groups of p summed path costs out, one group an
/// iteration (matching.hpp; paper, "Stereo Matching"). The interval is per iteration. With southern paths the
/// whole frame goes in before the first costs come out.
class MatchingStage final : public Stage {
 public:
  StreamIn<CensusCode> in_left{"in_left"};
  StreamIn<CensusCode> in_right{"in_right"};
  StreamOut<Cost> out_costs{"out_costs"};  ///< a token is p costs

  MatchingStage(const sc_core::sc_module_name& name, const MatchingConfig& config, int code_bits,
                const StageTiming& timing, const StageContext& context);

  std::uint64_t look_ahead() const { return look_ahead_; }
  Bits storage() const { return Bits(kernel_.storage_bits()); }

 private:
  Matching kernel_;
  RowJoin<CensusCode, CensusCode> codes_;
  std::uint64_t look_ahead_;
};

}  // namespace parallax
