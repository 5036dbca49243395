// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "modules/pixel.hpp"
#include "modules/row_ring.hpp"
#include "modules/row_sink.hpp"

namespace parallax {

struct SpeckleConfig {
  /// Passes of the filter, 0..4, 0 = off; default 2 (S, device software; the upper limit is our own).
  int iterations = 2;
  /// w_s, width and height of the window in px, odd, 3..31 (S: it exists). The default of this and the next
  /// two fields is our own, chosen on real pairs (tests/fidelity/quality_test.cpp).
  int window = 5;
  /// Smallest share of the window, in percent, that must be similar to the centre. 0..100. Own choice.
  int min_similar_percent = 36;
  /// Disparities are similar when they differ by at most this, in 1/16 px. 0..4094. Own choice.
  int max_difference = 16;

  void validate() const;
};

/// Speckle filter: invalidates small clusters of wrong matches (paper, "Speckle Filtering"). The device's
/// parameter "iterations" points to a fixed window applied repeatedly (inference) where the paper speaks of
/// connected components: a cluster smaller than the window has too few supporters in it.
///
/// Definition of one pass. h = (window - 1) / 2. n(x, y) is the number of pixels in the window x-h..x+h,
/// y-h..y+h, the centre itself included, that lie inside the image, are valid, and differ from the centre's
/// disparity by at most max_difference. A valid pixel becomes invalid (Cause::kSpeckle) when
///   100 * n < min_similar_percent * window * window.
/// All decisions of a pass use the pass's input. Pass k+1 takes the output of pass k. Invalid pixels keep
/// their cause.
class Speckle {
 public:
  Speckle(const SpeckleConfig& config, int width, int height);

  void push(const Disparity* row, const RowSink<Disparity>& emit);

  int look_ahead_rows() const;
  int look_ahead_pixels() const;
  /// `at_once`: pixels of a row that the circuit works on in one firing, in windows side by side.
  std::int64_t storage_bits(int at_once = 1) const;

 private:
  /// One pass over the image, itself a row kernel.
  class Pass {
   public:
    Pass(const SpeckleConfig& config, int width, int height);
    void push(const Disparity* row, const RowSink<Disparity>& emit);

   private:
    void filter_row(int y);

    int width_;
    int height_;
    int half_;
    std::uint16_t max_difference_;
    int min_count_;
    RowRing<Disparity> rows_;        ///< not decided yet
    RowRing<std::uint16_t> values_;  ///< the pass's input, invalid as kSimilarToNone
    std::vector<std::uint16_t> counts_;
    int in_row_ = 0;
    int out_row_ = 0;
  };

  void push_pass(std::size_t index, const Disparity* row, const RowSink<Disparity>& emit);

  SpeckleConfig config_;
  int width_;
  std::vector<Pass> passes_;
};

}  // namespace parallax
