// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace parallax {

/// One of several parts of an exploration's points, each for a computer of its own: every so many-th point,
/// as neighbours take about as long as each other.
struct PointShare {
  std::size_t index = 0;  ///< from 0
  std::size_t parts = 1;

  bool has(std::size_t number) const { return number % parts == index; }
  /// Of so many points.
  std::size_t size(std::size_t points) const { return (points + parts - 1 - index) / parts; }
};

}  // namespace parallax
