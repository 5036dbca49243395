// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "modules/pixel.hpp"
#include "modules/require_range.hpp"
#include "modules/row_sink.hpp"
#include "platform/config/schema.hpp"

namespace parallax {

struct FillFromBelowConfig {
  int reach = 3;  ///< rows, 0..16: how far a disparity is carried

  void validate() const { require_range("fill_from_below.reach", reach, 0, 16); }
};

inline void describe(Schema& schema, FillFromBelowConfig& config) {
  schema.integer("fill_from_below.reach", config.reach, {0, 16}, "rows", "How far a disparity is carried.",
                 chosen("an example"));
}

/// An invalid pixel takes the disparity of the nearest valid pixel below it, if that is at most `reach` rows
/// away: FillFromLeft with a look-ahead.
class FillFromBelow {
 public:
  FillFromBelow(const FillFromBelowConfig& config, int width, int height)
      : config_(config), width_(width), height_(height) {
    config.validate();
  }

  void push(const Disparity* row, const RowSink<Disparity>& emit) {
    rows_.emplace_back(row, row + width_);
    if (rows_.size() > static_cast<std::size_t>(config_.reach)) emit_first(emit);
    if (++taken_ < height_) return;
    taken_ = 0;
    while (!rows_.empty()) emit_first(emit);
  }

  int look_ahead_rows() const { return config_.reach; }
  int look_ahead_pixels() const { return 0; }
  /// The rows below.
  std::int64_t storage_bits() const { return std::int64_t{12} * width_ * config_.reach; }

 private:
  void emit_first(const RowSink<Disparity>& emit) {
    std::vector<Disparity> filled = rows_.front();
    for (std::size_t x = 0; x < filled.size(); ++x) {
      for (std::size_t below = 1; below < rows_.size() && !filled[x].valid(); ++below) {
        if (rows_[below][x].valid()) filled[x] = {rows_[below][x].value, Cause::kInterpolated};
      }
    }
    rows_.pop_front();
    emit(filled.data());
  }

  FillFromBelowConfig config_;
  int width_;
  int height_;
  int taken_ = 0;                            // rows of the frame
  std::deque<std::vector<Disparity>> rows_;  // not emitted yet
};

}  // namespace parallax
