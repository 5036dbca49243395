// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "modules/pixel.hpp"
#include "modules/row_ring.hpp"
#include "modules/row_sink.hpp"

namespace parallax {

/// What a pixel is replaced by.
enum class NoiseReductionKind {
  kMean,       ///< mean of its similar neighbours
  kMedian,     ///< median of its similar neighbours
  kMedian3x3,  ///< median of all pixels around it, similar or not, as a plain sorting network has it
  kMedian5x5,
};

struct NoiseReductionConfig {
  /// Off: disparities pass unchanged, no look-ahead. Default on (S, device software).
  bool enabled = true;
  /// Own choice: the device's filter is not published.
  NoiseReductionKind kind = NoiseReductionKind::kMean;
  /// Width and height of the neighbourhood in px, odd, 3..7; of the first two kinds. Own choice.
  int window = 3;
  /// Neighbours that differ from the centre by more than this, in 1/16 px, belong to another surface.
  /// 0..4094; of the first two kinds. Own choice.
  int max_difference = 24;

  bool of_similar() const { return kind == NoiseReductionKind::kMean || kind == NoiseReductionKind::kMedian; }
  int side() const;  ///< of the neighbourhood, px
  void validate() const;
};

/// Noise reduction: smooths within a surface, keeps discontinuities and invalid pixels (paper, "Noise
/// Reduction").
///
/// Definition. h = (window - 1) / 2. For a valid pixel with disparity c, N is the collection of the
/// disparities in the window x-h..x+h, y-h..y+h that lie inside the image, are valid, and differ from c by at
/// most max_difference; c is one of them. n is their number, s their sum. The pixel becomes
///   kMean:   floor((2 * s + n) / (2 * n)), the mean rounded to nearest, halves up;
///   kMedian: the element at position floor((n - 1) / 2) of N in ascending order (the lower one of two).
/// Causes stay. Invalid pixels pass unchanged.
///   kMedian3x3, kMedian5x5: each pixel, valid or not, whose window of 3x3 or 5x5 lies inside the image
///   becomes
///            the element at position (n - 1) / 2 of all n = 9 or 25 disparities in it, in ascending order,
///            an invalid one being 0xFFF and so the largest: the result is invalid where most of them are.
///            All other pixels pass unchanged. Where a valid pixel becomes invalid its cause is kNoise, the
///            other way round kMatched; other causes stay.
/// All reads are of the input.
///
/// The division is exact. A circuit multiplies by a stored reciprocal, one for each n (49 at most), as this
/// code does: with m = floor(2^32 / (2n)) + 1, floor(v / (2n)) = (v * m) >> 32 for all v < 2^32 / (2n), and v
/// < 2^19 here.
class NoiseReduction {
 public:
  NoiseReduction(const NoiseReductionConfig& config, int width, int height);

  void push(const Disparity* row, const RowSink<Disparity>& emit);

  int look_ahead_rows() const;
  int look_ahead_pixels() const;
  /// `at_once`: pixels of a row that the circuit works on in one firing, in windows side by side.
  std::int64_t storage_bits(int at_once = 1) const;

 private:
  void mean_row(int y, Disparity* out);
  void median_row(int y, Disparity* out);
  void plain_median_row(int y, Disparity* out);

  NoiseReductionConfig config_;
  int width_;
  int height_;
  int half_;
  RowRing<Disparity> rows_;
  RowRing<std::uint16_t> values_;  ///< of rows_, invalid as kSimilarToNone
  std::vector<std::uint32_t> sums_;
  std::vector<std::uint16_t> counts_;
  std::vector<std::uint64_t> reciprocals_;  ///< by n: floor(2^32 / (2n)) + 1
  std::vector<Disparity> output_;
  int in_row_ = 0;
  int out_row_ = 0;
};

}  // namespace parallax
