// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace parallax {

/// One of several parts of an exploration's points, each for a computer of its own. Of every so many points
/// in a row each part has one, and from row to row another: where the last axis has as many values as there
/// are parts, each part has all of them, and about as much to do.
struct PointShare {
  std::size_t index = 0;  ///< from 0
  std::size_t parts = 1;

  bool has(std::size_t number) const { return (number + number / parts) % parts == index; }
  /// Of so many points.
  std::size_t size(std::size_t points) const {
    const std::size_t rows = points / parts;
    const std::size_t place = (index + parts - rows % parts) % parts;  // in the last row, which may be cut
    return rows + (place < points % parts ? 1 : 0);
  }
};

}  // namespace parallax
