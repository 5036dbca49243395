// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "modules/matching.hpp"
#include "modules/pixel.hpp"

namespace parallax {

/// Matching costs C of one row (see Matching): each left pixel against the right pixels of all disparities,
/// one byte a cost.
class CostRow {
 public:
  CostRow(const MatchingConfig& config, int width, int code_bits);

  /// How many right pixels before a row, in raster order, its costs need.
  std::size_t reach() const { return outside_ == OutsideCost::kDelayLine ? range_.last() : 0; }
  /// `before`: these pixels, the last one that which the row follows. `costs` holds width * range.count
  /// bytes.
  void compute(const CensusCode* left, const CensusCode* right, const CensusCode* before,
               std::uint8_t* costs);

 private:
  DisparityRange range_;
  MatchingCost cost_;
  OutsideCost outside_;
  int width_;
  std::uint8_t outside_value_;  ///< the cost there, if it is the same for all
  std::uint8_t weight_;
  int planes_;                       ///< bytes of a code
  int plane_size_;                   ///< width, then the pixels left of the image
  std::vector<std::uint8_t> right_;  ///< byte planes of the right row, mirrored: disparities ascend in memory
};

}  // namespace parallax
