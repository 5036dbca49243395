// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace parallax {

/// A frame's values in raster order as they stand in a plain delay line: a row with the `reach` values before
/// it and behind it, whichever rows these belong to; 0 before the frame's first value and behind its last
/// one.
template <class T>
class RasterDelay {
 public:
  RasterDelay(int width, int reach) : width_(width), reach_(reach) {}

  /// Before each frame.
  void clear() { values_.assign(static_cast<std::size_t>(reach_), T{0}); }
  void push(const T* row) { values_.insert(values_.end(), row, row + width_); }
  /// After the frame's last row.
  void end() { values_.insert(values_.end(), static_cast<std::size_t>(reach_), T{0}); }

  /// Whether all that row() reaches has come.
  bool complete() const { return values_.size() >= 2 * static_cast<std::size_t>(reach_) + width_; }
  /// First value of the oldest row; -reach .. width + reach - 1 may be read.
  const T* row() const { return values_.data() + reach_; }
  void pop() { values_.erase(values_.begin(), values_.begin() + width_); }

 private:
  int width_;
  int reach_;
  std::vector<T> values_;
};

}  // namespace parallax
