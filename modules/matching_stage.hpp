// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <systemc>

#include "modules/frame_changes.hpp"
#include "modules/kept_rows.hpp"
#include "modules/matching.hpp"
#include "modules/raster_schedule.hpp"
#include "modules/row_join.hpp"
#include "tlm/stage.hpp"

namespace parallax {

/// Semi-global matching: a pair of census codes in, n_i groups of p summed path costs out, one group an
/// iteration (matching.hpp; paper, "Stereo Matching"). The interval is per iteration; a pixel takes
/// max(n_i * interval, (n_i - 1) * interval + recurrence_latency) cycles, and max(n_i * interval,
/// recurrence_latency) where the minimum is taken before the update (RecurrenceOrder). With southern paths
/// the whole frame goes in before the first costs come out.
///
/// Several pixels a token are worked on one after the other, those of parallel rows at once: then a token of
/// costs is a group of each row, and dates are those of a raster order, as rows that wait for their turn, and
/// for the rows above to be out, make it (MatchingConfig).
///
/// What the matcher keeps outside (MatchingStore) leaves and comes back through ports of its own, a token a
/// pixel: rows out with a pixel's last iteration, and back with the first one of the pixel below; the frame
/// out in the first pass, and back, last pixel first, in the second. The kernel goes on with the values that
/// it holds; what comes back must be the same: SC_REPORT_ERROR /parallax/matching/kept when it is not.
class MatchingStage final : public Stage {
 public:
  StreamIn<CensusCode> in_left{"in_left"};
  StreamIn<CensusCode> in_right{"in_right"};
  StreamOut<Cost> out_costs{"out_costs"};  ///< a token is p costs
  /// There if something is kept (no row of an image that has one only); declared in this order.
  std::unique_ptr<StreamIn<std::uint8_t>> in_rows, in_frame;
  std::unique_ptr<StreamOut<std::uint8_t>> out_rows, out_frame;

  MatchingStage(const sc_core::sc_module_name& name, const MatchingConfig& config, int code_bits,
                const StageTiming& timing, const StageContext& context);

  /// The configuration for the next frame that has none yet, or none: as before. What fixes the schedule
  /// must not change.
  void configure(const std::optional<MatchingConfig>& config) { changes_.push(config); }
  /// Before the simulation; `taps` are asked with each row, and must outlive it.
  void open(const MatchingTaps& taps) {
    taps_ = &taps;
    kernel_->open(taps);
  }
  std::uint64_t look_ahead() const { return look_ahead_; }
  Bits storage() const { return storage_; }
  const MatchingStore& store() const { return store_; }

 private:
  void keep_rows();
  void keep_frame();

  std::optional<Matching> kernel_;
  FrameChanges<MatchingConfig> changes_;
  RowJoin<CensusCode, CensusCode> codes_;
  std::uint64_t look_ahead_;
  Bits storage_;
  MatchingStore store_;
  KeptRows rows_kept_;
  KeptRows frame_kept_;
  MatchingKeeper keeper_;
  const MatchingTaps* taps_ = nullptr;  // none are open
};

}  // namespace parallax
