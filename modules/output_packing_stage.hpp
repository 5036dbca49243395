// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>
#include <vector>

#include "modules/output_packing.hpp"
#include "modules/raster_schedule.hpp"
#include "modules/row_join.hpp"
#include "tlm/stage.hpp"

namespace parallax {

/// Which columns of a pass over the image go out: [begin, end), both even but for an end at the last column.
struct PackedColumns {
  int begin = 0;
  int end = 0;
};

/// What output packing packs.
struct OutputPackingConfig {
  Bytes burst{128};
  OutputLeft left = OutputLeft::kGrey;
  std::vector<PackedColumns> passes;  ///< of one frame, each over context.height rows of context.width pixels
};

/// Output packing: a rectified left pixel and its disparity in, one cycle each; a burst out when its last
/// byte is packed, at most one a cycle (output_packing.hpp). A frame of one pass over all columns is packed
/// as one piece; else each row is one, as it goes to an address of its own, and pixels of other columns are
/// dropped.
class OutputPackingStage final : public Stage {
 public:
  StreamIn<Gray> in_left{"in_left"};
  StreamIn<Disparity> in_disparity{"in_disparity"};
  StreamOut<std::uint8_t> out_bursts{"out_bursts"};

  OutputPackingStage(const sc_core::sc_module_name& name, const OutputPackingConfig& config,
                     const StageContext& context);

  /// The burst in the making.
  Bits storage() const { return Bits(kernels_.front().storage_bits()) + burst_; }

 private:
  void pack(const Gray* left, const Disparity* disparities);

  const OutputLeft left_;
  const std::vector<PackedColumns> passes_;
  const int height_;
  std::vector<OutputPacking> kernels_;  // one a pass
  Bits burst_;
  std::size_t pass_ = 0;  // under way
  int y_ = 0;             // its next row
  RowJoin<Gray, Disparity> rows_;
};

}  // namespace parallax
