// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "modules/pixel.hpp"
#include "modules/require_range.hpp"
#include "modules/row_sink.hpp"

namespace parallax {

struct FillFromLeftConfig {
  int reach = 4;  ///< px, 0..255: how far a disparity is carried

  void validate() const { require_range("fill_from_left.reach", reach, 0, 255); }
};

/// An invalid pixel takes the disparity of the nearest valid pixel to its left, if that is at most `reach`
/// away.
class FillFromLeft {
 public:
  FillFromLeft(const FillFromLeftConfig& config, int width, int /*height*/)
      : config_(config), row_(static_cast<std::size_t>(width)) {
    config.validate();
  }

  void push(const Disparity* row, const RowSink<Disparity>& emit) {
    Disparity last;
    int distance = 0;
    for (std::size_t x = 0; x < row_.size(); ++x) {
      row_[x] = row[x];
      ++distance;
      if (row[x].valid()) {
        last = row[x];
        distance = 0;
      } else if (last.valid() && distance <= config_.reach) {
        row_[x] = {last.value, Cause::kInterpolated};
      }
    }
    emit(row_.data());
  }

  int look_ahead_rows() const { return 0; }
  int look_ahead_pixels() const { return 0; }
  /// The disparity carried and its distance.
  std::int64_t storage_bits() const { return 12 + 8; }

 private:
  FillFromLeftConfig config_;
  std::vector<Disparity> row_;
};

}  // namespace parallax
