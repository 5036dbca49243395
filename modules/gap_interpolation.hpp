// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "modules/pixel.hpp"
#include "modules/row_ring.hpp"
#include "modules/row_sink.hpp"

namespace parallax {

/// How an interpolated value between two steps of 1/16 px is brought to one of them.
enum class InterpolationRounding {
  kNearest,   ///< to the nearest step, halves up
  kTruncate,  ///< to the step below
};

struct GapInterpolationConfig {
  /// Off: disparities pass unchanged, no look-ahead. Default on (S, device software).
  bool enabled = true;
  /// l_max, longest gap that is filled, in px, 0..64 (S: it exists, not exposed by the device; the numbers
  /// are ours, the default chosen on real pairs).
  int l_max = 12;
  /// The two edges of a gap are similar when they differ by at most this, in 1/16 px. 0..4094. Own choice:
  /// 1.5 px, as noise reduction; with 1 px the slanted ground of road scenes keeps many small gaps.
  int max_difference = 24;
  /// Own choice: not published.
  InterpolationRounding rounding = InterpolationRounding::kNearest;

  void validate() const;
};

/// Gap interpolation: fills small gaps from their edges (paper, "Gap Interpolation").
///
/// Definition. All reads are of the input, never of a filled value. A pixel is a gap pixel when it is invalid
/// and its cause is not kBorder. Its horizontal run is the longest stretch of gap pixels on its row that
/// contains it, of length l_h; its edges are the pixels next to both ends. The run can be bridged when
///   - both edges are inside the image and valid (an edge that is a masked border pixel is not),
///   - l_h <= l_max,
///   - the edges' disparities a (left) and b (right) differ by at most max_difference.
/// The vertical run, of length l_v, a above and b below, likewise. A gap pixel is filled along the shorter
/// one of the runs that can be bridged, along the horizontal one if they are equally long, and stays as it is
/// if there is none. (So the paper's min(l_h, l_v) <= l_max holds for each filled pixel, and a gap whose
/// short way leads from one object to another may still be filled along the other way.) Its value, as the
/// i-th pixel (1..l) of a run of length l, is
///   kTruncate: floor((a * (l + 1 - i) + b * i) / (l + 1));
///   kNearest:  floor((2 * (a * (l + 1 - i) + b * i) + l + 1) / (2 * (l + 1))),
/// and its cause Cause::kInterpolated.
class GapInterpolation {
 public:
  GapInterpolation(const GapInterpolationConfig& config, int width, int height);

  void push(const Disparity* row, const RowSink<Disparity>& emit);

  int look_ahead_rows() const;
  int look_ahead_pixels() const;
  /// `at_once`: pixels of a row that the circuit works on in one firing, in windows side by side.
  std::int64_t storage_bits(int at_once = 1) const;

 private:
  /// A stretch of gap pixels between two similar edges. length 0: there is none.
  struct Run {
    int first = 0;
    int last = 0;
    int length = 0;
  };
  struct VerticalRun {
    Run run;
    int top = 0;  ///< its first row
  };

  Run bridge(const Disparity& first, const Disparity& last, int length) const;
  Run vertical_run(int x, int y) const;
  void update_vertical_runs(int y);
  void fill_row(int y);
  Disparity fill(const Run& run, int position) const;

  GapInterpolationConfig config_;
  int width_;
  int height_;
  RowRing<Disparity> rows_;                 ///< the row above the current one, and all that it looks ahead to
  std::vector<VerticalRun> vertical_runs_;  ///< of each column; stale where the current row has no gap
  std::vector<Disparity> output_;
  int in_row_ = 0;
  int out_row_ = 0;
};

}  // namespace parallax
