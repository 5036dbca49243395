// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "modules/rectification_map.hpp"
#include "modules/row_sink.hpp"
#include "platform/input/calibration.hpp"

namespace parallax {

/// Rectification maps as cv::remap takes them: for every rectified pixel the x and y of the raw pixel.
/// CV_32FC1, all of one size. They may be a band of the image: its rows first_row, first_row + 1, ...
struct RawMaps {
  cv::Mat left_x;
  cv::Mat left_y;
  cv::Mat right_x;
  cv::Mat right_y;
  int first_row = 0;
};

/// Full-resolution maps of a calibration (initUndistortRectifyMap).
RawMaps raw_maps(const Calibration& calibration);

/// The same maps in bands, top to bottom, so that the memory they take does not grow with the image's height.
void for_each_band(const Calibration& calibration, const std::function<void(const RawMaps& band)>& take);

/// The same maps at columns x0, x0 + step, ... and rows likewise: columns * rows samples that reach from the
/// first to the last pixel of the image.
RawMaps sampled_maps(const Calibration& calibration, int columns, int rows);

/// The maps that a quantised map stands for; exact.
RawMaps raw_maps(const RectificationMap& map);

/// What a window has to hold, and what it does not.
struct WindowSurvey {
  struct Image {
    std::size_t beyond = 0;  ///< pixels with an offset beyond the window
    int x = 0;               ///< the first of them in raster order
    int y = 0;
    double dx = 0;  ///< its offset, px
    double dy = 0;
  };
  Image left;
  Image right;
  int width = 0;           ///< px, of the maps
  std::size_t pixels = 0;  ///< of each image
  double largest = 0;      ///< offset of both images, in 1/2^fraction_bits px
  /// Smallest window that holds all offsets; 0 if none does, because some pixel lies behind the camera.
  int window_needed = 1;

  bool fits() const { return left.beyond == 0 && right.beyond == 0; }
  /// Takes in one more band of the maps.
  void add(const RawMaps& band, const OffsetRange& range);
};

WindowSurvey survey(const RawMaps& maps, const OffsetRange& range);

/// One line: the image, the first pixel, its offset, how many are affected, and the window that would do.
/// `remedy` is appended.
std::string describe(const WindowSurvey& survey, const OffsetRange& range, const std::string& remedy);

/// Rounds every coordinate to 2^-fraction_bits px, half to even, as cv::remap does, and makes it relative.
/// The offsets must fit (see survey()).
RectificationMap quantise(const RawMaps& maps, const OffsetRange& range);

/// Hands out the quantised rows of a band whose offsets are known to fit.
void quantise_rows(const RawMaps& band, const OffsetRange& range, const RowSink<OffsetPair>& emit);

}  // namespace parallax
