// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "modules/output_packing.hpp"
#include "modules/raster_schedule.hpp"
#include "modules/row_join.hpp"
#include "tlm/stage.hpp"

namespace parallax {

/// Output packing: a rectified left pixel and its disparity in, one cycle each; a burst out when its last
/// byte is packed, at most one a cycle (output_packing.hpp).
class OutputPackingStage final : public Stage {
 public:
  StreamIn<Gray> in_left{"in_left"};
  StreamIn<Disparity> in_disparity{"in_disparity"};
  StreamOut<std::uint8_t> out_bursts{"out_bursts"};

  OutputPackingStage(const sc_core::sc_module_name& name, Bytes burst, const StageContext& context);

  /// The burst in the making.
  Bits storage() const { return Bits(kernel_.storage_bits()) + burst_; }
  /// Told of each row of disparities with the causes that the packed bytes do not carry; a view for the
  /// model's user, not a part of the machine.
  void tap(std::function<void(const Disparity* row)> tap) { tap_ = std::move(tap); }

 private:
  OutputPacking kernel_;
  Bits burst_;
  std::function<void(const Disparity*)> tap_;
  RowJoin<Gray, Disparity> rows_;
};

}  // namespace parallax
