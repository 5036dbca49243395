// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "modules/raster_schedule.hpp"
#include "modules/row_join.hpp"
#include "modules/uniqueness.hpp"
#include "tlm/stage.hpp"

namespace parallax {

/// Uniqueness check: the cost groups of a pixel and, with the last one, its disparity in; the disparity out
/// (uniqueness.hpp; paper, "Uniqueness Check").
class UniquenessStage final : public Stage {
 public:
  StreamIn<Cost> in_costs{"in_costs"};  ///< a token is one group of costs
  StreamIn<Disparity> in_disparity{"in_disparity"};
  StreamOut<Disparity> out_disparity{"out_disparity"};

  /// `groups`: cost tokens a pixel.
  UniquenessStage(const sc_core::sc_module_name& name, const UniquenessConfig& config, DisparityRange range,
                  std::uint32_t groups, const StageTiming& timing, const StageContext& context);

  std::uint64_t look_ahead() const { return look_ahead_; }
  Bits storage() const { return Bits(kernel_.storage_bits()); }

 private:
  Uniqueness kernel_;
  RowJoin<Cost, Disparity> rows_;
  std::uint64_t look_ahead_;
};

}  // namespace parallax
