// SPDX-License-Identifier: Apache-2.0
#include "traces/row_ends.hpp"

#include <algorithm>
#include <numeric>

namespace parallax {

RowEnds rows_of_lengths(const std::vector<std::uint64_t>& lengths, std::int32_t rows_of_a_tile) {
  RowEnds rows;
  rows.rows_of_a_tile = rows_of_a_tile;
  rows.ends.resize(lengths.size());
  std::partial_sum(lengths.begin(), lengths.end(), rows.ends.begin());
  return rows;
}

RowEnds equal_rows(std::uint64_t units_of_a_row, std::int32_t rows, std::int32_t tiles) {
  RowEnds ends;
  ends.rows_of_a_tile = rows;
  for (std::int64_t row = 1; row <= std::int64_t{rows} * tiles; ++row) {
    ends.ends.push_back(units_of_a_row * row);
  }
  return ends;
}

std::uint64_t RowEnds::first_of(std::int64_t number, std::int32_t row) const {
  const std::uint64_t frames = frame() * number;
  const std::size_t before = std::min(row, rows_of_a_tile);
  return before == 0 || ends.empty() ? frames : frames + ends[std::min(before, ends.size()) - 1];
}

std::uint64_t RowEnds::end_of(std::int64_t number, std::int32_t row) const {
  const std::uint64_t frames = frame() * number;
  const std::size_t after = std::max(0, rows_of_a_tile - 1 - row);
  return after >= ends.size() ? frames : frames + ends[ends.size() - 1 - after];
}

void RowCursor::leave_row() {
  const std::vector<std::uint64_t>& ends = ends_->ends;
  // As a rule it is in the next row, or in the one after that.
  for (int i = 0; i < 2 && row_ < ends.size() && at_ >= ends[row_]; ++i) ++row_;
  if (row_ == ends.size() || at_ >= ends[row_]) {
    const std::uint64_t frame = ends_->frame();
    place_.frame += at_ / frame;
    at_ %= frame;
    row_ = std::upper_bound(ends.begin(), ends.end(), at_) - ends.begin();
  }
  end_ = ends[row_];
  place_.tile = static_cast<std::int32_t>(row_) / ends_->rows_of_a_tile;
  place_.row = static_cast<std::int32_t>(row_) % ends_->rows_of_a_tile;
}

}  // namespace parallax
