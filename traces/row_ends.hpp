// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "traces/trace_event.hpp"

namespace parallax {

/// Where the rows of a frame end in what passes a stream or a port: tokens or bytes of the frame until the
/// end of each row, tile by tile.
struct RowEnds {
  std::vector<std::uint64_t> ends;
  std::int32_t rows_of_a_tile = 1;

  std::uint64_t frame() const { return ends.empty() ? 0 : ends.back(); }
  /// Units before row `row` of frame `frame` (both from 0), in the first tile.
  std::uint64_t first_of(std::int64_t frame, std::int32_t row) const;
  /// Units until the end of that row in the last tile, or of its last row if it has no such row.
  std::uint64_t end_of(std::int64_t frame, std::int32_t row) const;
};

/// Rows of the given lengths, tile by tile.
RowEnds rows_of_lengths(const std::vector<std::uint64_t>& lengths, std::int32_t rows_of_a_tile);

/// Rows of equal length.
RowEnds equal_rows(std::uint64_t units_of_a_row, std::int32_t rows, std::int32_t tiles);

/// Follows what passes through rows and frames.
class RowCursor {
 public:
  /// `ends` must not be empty.
  explicit RowCursor(std::shared_ptr<const RowEnds> ends) : ends_(std::move(ends)), end_(ends_->ends[0]) {}

  /// Of the next unit.
  const TracePosition& position() const { return place_; }
  /// Units until the row ends.
  std::uint64_t left_in_row() const { return end_ - at_; }
  void advance(std::uint64_t units) {
    at_ += units;
    if (at_ >= end_) leave_row();
  }

 private:
  void leave_row();

  std::shared_ptr<const RowEnds> ends_;
  std::size_t row_ = 0;
  std::uint64_t end_;     // of that row
  std::uint64_t at_ = 0;  // units of the frame
  TracePosition place_{0, 0, 0};
};

}  // namespace parallax
