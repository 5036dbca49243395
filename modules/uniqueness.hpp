// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "modules/pixel.hpp"
#include "modules/row_sink.hpp"
#include "modules/winner.hpp"

namespace parallax {

struct UniquenessConfig {
  bool enabled = true;  ///< S (device default: on)
  /// q in 1/256, 256..4096 (q = 1..16; S: q >= 1). 1.15: own choice, from pairs with ground truth; how the
  /// device's sensitivity (0..256, default 65, S) maps to q is not published.
  int factor = 294;
  /// Whether the two disparities next to the minimum count as a match of their own. They belong to the same
  /// minimum and are nearly as cheap wherever the true disparity lies half-way; own choice.
  bool neighbours_are_rivals = false;

  void validate() const;
};

/// Uniqueness check: a match must be cheaper than the next best one by the factor q.
///
/// For a valid disparity with integer part d (integer_disparity), k = d - range.offset and the pixel's costs
/// S(0..D-1): c = S(k); rival = the lowest S(j) with j != k, and with neighbours_are_rivals off also
/// j != k-1, j != k+1. The disparity is kept if c * factor < rival * 256 or if there is no such j; otherwise
/// it becomes invalid with kUniqueness. Invalid disparities pass unchanged; so does everything when disabled.
class Uniqueness {
 public:
  Uniqueness(const UniquenessConfig& config, DisparityRange range, int width, int height);

  /// One row of width * range.count costs with the disparities that come from it; emits rows of `width`
  /// disparities.
  void push(const Cost* costs, const Disparity* disparities, const RowSink<Disparity>& emit);

  int look_ahead_rows() const { return 0; }
  int look_ahead_pixels() const { return 0; }

  /// The lowest four costs with their indices: whatever the minimum turns out to be, its two neighbours can
  /// be left out and a rival remains.
  /// `at_once`: pixels, of as many rows, that the circuit works on in one firing.
  std::int64_t storage_bits(int at_once = 1) const;

 private:
  bool unique(const Cost* costs, int k) const;

  UniquenessConfig config_;
  DisparityRange range_;
  int width_;
  std::vector<Disparity> row_;
};

}  // namespace parallax
