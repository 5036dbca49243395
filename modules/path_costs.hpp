// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "modules/matching.hpp"
#include "modules/path_step.hpp"
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
  /// `whole_row`: at() is asked for pixels of the row above also of a horizontal path, which alone has no
  /// need of them.
  Path(PathBit bit, const MatchingConfig& config, int width, bool whole_row = false);

  PathBit bit() const { return bit_; }

  /// Next pixel (column x, row y) in raster order: its path costs from the matching costs, added to `sums`.
  void advance(int x, int y, const std::uint8_t* costs, Cost* sums);

  /// Of a pixel that was advanced to at most a row ago, or if neither the next row needs them nor the whole
  /// row is held, a pixel ago.
  PathCosts at(int x, int y) { return slot(y * width_ + x); }
  /// Whether the next row needs them.
  bool from_above() const { return step_.rows_up != 0; }

 private:
  PathCosts slot(int position);
  void step(int x, int y, const std::uint8_t* costs, Cost* sums);
  void advance_narrow(int x, int y, const std::uint8_t* costs, Cost* sums);
  void narrow(const PathCosts& here, Cost* sums) const;

  PathBit bit_;
  PathStep step_;
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
