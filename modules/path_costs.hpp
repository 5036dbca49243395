// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "modules/matching.hpp"
#include "modules/pixel.hpp"

namespace parallax {

/// Path costs of one pixel and their minimum: D values between two guards that never win.
struct PathCosts {
  static constexpr int kGuard =
      8;                ///< values between two pixels: one is needed, eight keep 16-byte alignment
  std::int16_t* costs;  ///< costs[-1] and costs[D] are guards
  std::int16_t* minimum;
};

/// One path of semi-global matching through an image that is scanned in raster order: a delay line of path
/// costs, as the circuit has. The predecessor lies a fixed number of raster positions back.
class Path {
 public:
  /// `dx` -1, 0 or 1 and `rows_up` 0 or 1: where the predecessor lies.
  struct Direction {
    int dx;
    int rows_up;
  };
  Path(Direction direction, const MatchingConfig& config, int width);

  /// Next pixel (column x, row y) in raster order: its path costs from the matching costs, added to `sums`.
  void advance(int x, int y, const std::uint8_t* costs, Cost* sums);

  /// Of a pixel that was advanced to at most a row ago.
  PathCosts at(int x, int y) { return slot(y * width_ + x); }
  /// Whether the next row needs them.
  bool from_above() const { return direction_.rows_up != 0; }

 private:
  PathCosts slot(int position);
  void step(int x, int y, const std::uint8_t* costs, Cost* sums);
  void advance_narrow(int x, int y, const std::uint8_t* costs, Cost* sums);
  void narrow(const PathCosts& here, Cost* sums) const;
  int predecessor(int x, int y) const;  ///< raster position, negative if there is none

  Direction direction_;
  PathStart start_;
  int restart_column_;  ///< where all pixels start anew
  int count_;
  std::int16_t p1_;
  std::int16_t p2_;
  bool narrow_;  ///< path costs may not fit in the circuit's registers
  PathOverflow overflow_;
  std::int16_t largest_;  ///< in these registers
  int width_;
  int slots_;
  std::vector<std::int16_t> costs_;
  std::vector<std::int16_t> minima_;
};

}  // namespace parallax
