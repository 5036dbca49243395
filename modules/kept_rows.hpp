// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace parallax {

/// Rows that have left for a store outside and are to come back as they were: in the order in which they
/// left, or block by block (a frame, say), the last row of a block first.
class KeptRows {
 public:
  /// `block`: rows of a block; 1 for rows that come back in order.
  explicit KeptRows(std::size_t block = 1) : block_(block) {}

  void leave(const std::uint8_t* row, std::size_t bytes) { rows_.emplace_back(row, row + bytes); }
  /// Whether the next row to come back is this one.
  bool come_back(const std::uint8_t* row, std::size_t bytes) {
    const std::size_t index = block_ - 1 - back_;
    if (index >= rows_.size()) return false;
    const std::vector<std::uint8_t>& left = rows_[index];
    const bool same = left.size() == bytes && std::equal(left.begin(), left.end(), row);
    if (++back_ == block_) {
      rows_.erase(rows_.begin(), rows_.begin() + block_);
      back_ = 0;
    }
    return same;
  }

 private:
  std::size_t block_;
  std::size_t back_ = 0;  // rows of the first block that have come back
  std::deque<std::vector<std::uint8_t>> rows_;
};

}  // namespace parallax
