// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "modules/pixel.hpp"
#include "modules/row_sink.hpp"
#include "modules/winner.hpp"

namespace parallax {

/// Curve through the costs at the minimum and its two neighbours.
enum class SubpixelCurve { kNone, kParabola, kEquiangular };

enum class SubpixelRounding { kTruncate, kNearest };

struct SubpixelConfig {
  /// S: "a curve is fitted"; which one: own choice. Census costs rise linearly beside their minimum, so that
  /// the equiangular fit locks less to whole pixels than the parabola.
  SubpixelCurve curve = SubpixelCurve::kEquiangular;
  SubpixelRounding rounding = SubpixelRounding::kTruncate;  ///< own choice
  TieRule winner = TieRule::kLowest;                        ///< own choice
  bool mask_border = true;                                  ///< S (device's "mask border pixels", default on)
  int border_width =
      2;  ///< px masked left and right, 0..31; 2: S (device image), the half window of census 5x5 (I)
  int border_height = 2;  ///< px masked at top and bottom, 0..31; as border_width

  void validate() const;
};

/// Winner takes all, then subpixel optimization: costs to a disparity in 1/16 px.
///
/// With costs S(0..D-1) of a pixel (D = range.count) and k the index of the lowest one (ties: `winner`),
///   value = (range.offset + k) * 16 + f,  cause = kMatched.
/// f is 0 when the curve is kNone and when k has a neighbour on one side only or none. Otherwise, with a =
/// S(k-1), c = S(k), b = S(k+1), the curve's minimum lies n / m sixteenths of a pixel from k:
///   parabola:    n = 8 * (a - b),  m = a - 2c + b
///   equiangular: n = 8 * (a - b),  m = max(a, b) - c
/// and f = 0 where m = 0; otherwise f is n / m rounded toward zero (kTruncate), or to the nearest integer
/// with halves away from zero (kNearest), except that |n / m| below 8 does not round up to 8 but to 7. So |f|
/// <= 8, and |f| = 8 if and only if the neighbour on that side ties with the winner (see integer_disparity).
///
/// With mask_border, a pixel with x < border_width, x >= width - border_width, y < border_height or
/// y >= height - border_height is invalid with kBorder. Every other pixel is valid: the largest value is 255
/// * 16.
class Subpixel {
 public:
  Subpixel(const SubpixelConfig& config, DisparityRange range, int width, int height);

  /// One row of width * range.count costs; emits rows of `width` disparities.
  void push(const Cost* costs, const RowSink<Disparity>& emit);

  int look_ahead_rows() const { return 0; }
  int look_ahead_pixels() const { return 0; }

  /// Best cost so far, its index and both its neighbours, the previous cost: one pixel in the making.
  /// `at_once`: pixels, of as many rows, that the circuit works on in one firing.
  std::int64_t storage_bits(int at_once = 1) const;

 private:
  Disparity refine(const Cost* costs) const;
  int fraction(int below, int best, int above) const;

  SubpixelConfig config_;
  DisparityRange range_;
  int width_;
  int height_;
  int next_row_ = 0;
  std::vector<Disparity> row_;
};

}  // namespace parallax
