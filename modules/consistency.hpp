// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "modules/pixel.hpp"
#include "modules/row_sink.hpp"
#include "modules/winner.hpp"

namespace parallax {

/// What becomes of a left pixel whose match lies left of the right image (x < d).
enum class OutsideMatch { kKeep, kInvalidate };

struct ConsistencyConfig {
  bool enabled = true;  ///< S (device default: on)
  /// t_c, px, 0..15. I: the device's sensitivity (0..15, default 13, S) taken as 15 - t_c.
  int threshold = 2;
  TieRule right_winner = TieRule::kLowest;                 ///< tie in the right map; own choice
  OutsideMatch outside_match = OutsideMatch::kInvalidate;  ///< own choice: nothing there could confirm it

  void validate() const;
};

/// Consistency check against a right disparity map inferred from the same costs (paper, "Consistency Check").
///
/// With the costs S(x, k) of a row, k = 0..D-1 and d = range.offset + k: d_r(u) of the right pixel u is the d
/// of the lowest S(u + d, k) over the k with u + d < width (ties: right_winner). A valid disparity at x with
/// integer part d_l (integer_disparity) and u = x - d_l is kept if |d_l - d_r(u)| <= threshold, and becomes
/// invalid with kConsistency otherwise; if u < 0, outside_match decides alone. Invalid disparities pass
/// unchanged; so does everything when disabled.
///
/// Near the left border this says: at column x only disparities up to x have a right pixel inside the image,
/// so with kInvalidate only those remain. The matcher still searches the whole range there, at the cost of
/// MatchingConfig::outside_cost; a pixel whose true match is not in the right image is a guess, invalid as a
/// rule.
class Consistency {
 public:
  Consistency(const ConsistencyConfig& config, DisparityRange range, int width, int height);

  /// One row of width * range.count costs with the disparities that come from it; emits rows of `width`
  /// disparities.
  void push(const Cost* costs, const Disparity* disparities, const RowSink<Disparity>& emit);

  /// The last cost that d_r(x - d_l) depends on is that of column x - d_l + d_max <= x + range.count - 1.
  int look_ahead_rows() const { return 0; }
  int look_ahead_pixels() const { return config_.enabled ? range_.count - 1 : 0; }

  /// Lowest cost and disparity of the right pixels in sight, and the disparities that wait for them.
  /// `at_once`: pixels, of as many rows, that the circuit works on in one firing.
  std::int64_t storage_bits(int at_once = 1) const;

 private:
  void match_right(const Cost* costs);

  ConsistencyConfig config_;
  DisparityRange range_;
  int width_;
  // Mirrored (right pixel u at width-1-u), so that the right pixels of one left pixel ascend with the
  // disparity.
  std::vector<Cost> right_lowest_;
  std::vector<std::uint16_t> right_index_;
  std::vector<Disparity> row_;
};

}  // namespace parallax
