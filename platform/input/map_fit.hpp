// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "modules/rectification_map.hpp"
#include "platform/input/calibration.hpp"

namespace parallax {

/// A rectification that has been zoomed and shifted so that its offsets fit into the window.
struct Fit {
  Calibration calibration;  ///< with the new P1, P2 and geometry
  double zoom = 1;          ///< new over old focal length, the same for both images
  double shift_left_x = 0;  ///< how far the principal point of the left image moved, px
  double shift_right_x = 0;
  double shift_y = 0;  ///< of both images
  /// Share of the pixels of both rectified images that lie outside the raw ones and repeat their edge, 0..1.
  double outside = 0;

  /// False if the images had to move differently, so that a point at infinity no longer has the disparity it
  /// had.
  bool common_shift() const { return shift_left_x == shift_right_x; }
  /// What was done, for the user: one line.
  std::string text() const;
};

/// The zoom nearest to 1 (0.25..4), and for it a small shift of the principal points, with which every offset
/// fits. Both images keep one focal length and one vertical position, so rows stay aligned; horizontally both
/// move alike unless only different shifts fit. Nothing if no zoom and shift do.
std::optional<Fit> fit(const Calibration& calibration, const OffsetRange& range);

/// The smallest window for which fit() finds something, for a lens that fits into `range` with no zoom and
/// shift; 0 if there is none.
int smallest_window(const Calibration& calibration, const OffsetRange& range);

}  // namespace parallax
