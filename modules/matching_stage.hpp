// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <systemc>

#include "modules/frame_changes.hpp"
#include "modules/matching.hpp"
#include "modules/raster_schedule.hpp"
#include "modules/row_join.hpp"
#include "tlm/stage.hpp"

namespace parallax {

/// Semi-global matching: a pair of census codes in, n_i groups of p summed path costs out, one group an
/// iteration (matching.hpp; paper, "Stereo Matching"). The interval is per iteration; a pixel takes
/// max(n_i * interval, (n_i - 1) * interval + recurrence_latency) cycles. With southern paths the
/// whole frame goes in before the first costs come out.
class MatchingStage final : public Stage {
 public:
  StreamIn<CensusCode> in_left{"in_left"};
  StreamIn<CensusCode> in_right{"in_right"};
  StreamOut<Cost> out_costs{"out_costs"};  ///< a token is p costs

  MatchingStage(const sc_core::sc_module_name& name, const MatchingConfig& config, int code_bits,
                const StageTiming& timing, const StageContext& context);

  /// The configuration for the next frame that was not told yet, or none: as before. What fixes the schedule
  /// must not change.
  void configure(const std::optional<MatchingConfig>& config) { changes_.push(config); }
  std::uint64_t look_ahead() const { return look_ahead_; }
  Bits storage() const { return storage_; }

 private:
  std::optional<Matching> kernel_;
  FrameChanges<MatchingConfig> changes_;
  RowJoin<CensusCode, CensusCode> codes_;
  std::uint64_t look_ahead_;
  Bits storage_;
};

}  // namespace parallax
