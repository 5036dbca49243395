// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "modules/area.hpp"

namespace parallax {

/// The last `rows` rows of a frame, addressed by their row number, with `margin` cells of `fill` on both
/// sides, so that a window may reach over the left and right image border without a test.
template <class T>
class RowRing {
 public:
  RowRing(int rows, int width, int margin, T fill)
      : rows_(rows), margin_(margin), stride_(width + 2 * margin), cells_(area(rows, stride_), fill) {}

  /// Column 0 of row y; columns -margin .. width+margin-1 may be read.
  T* row(int y) { return cells_.data() + offset(y); }
  const T* row(int y) const { return cells_.data() + offset(y); }

 private:
  std::ptrdiff_t offset(int y) const { return std::ptrdiff_t{y % rows_} * stride_ + margin_; }

  int rows_;
  int margin_;
  int stride_;
  std::vector<T> cells_;
};

}  // namespace parallax
