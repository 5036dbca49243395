// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "modules/pixel.hpp"
#include "modules/raster_delay.hpp"
#include "modules/row_sink.hpp"

namespace parallax {

/// Place of the top-left neighbour in the code; the others follow in raster order.
enum class CensusBitOrder { kMsbFirst, kLsbFirst };

/// When a neighbour's bit is 1: neighbour <op> centre.
enum class CensusComparison { kLess, kLessEqual, kGreater, kGreaterEqual };

/// What a window sees outside the image (of a tile: outside the tile).
enum class CensusBorder {
  kReplicate,  ///< the nearest pixel
  kZero,       ///< the value 0
  kMask,       ///< nothing: the code is 0
  kDelayLine,  ///< what a delay line without border handling holds at its taps: the neighbour dy rows and dx
               ///< columns away is the pixel dy * width + dx positions on in raster order, beyond the sides
               ///< that of the row before or behind; 0 before the frame's first pixel and behind its last one
};

/// The paper names neither the transform nor its window; the census transform is an inference from "more
/// robust towards illumination variations" and from the width of the device's masked border.
struct CensusConfig {
  /// Off: intensities pass unchanged in place of codes, no look-ahead, no storage. I, as the window below.
  bool enabled = true;
  int window_width = 5;  ///< px, odd, 1..63; 5: I, a device image has a masked border of 2 px
  int window_height =
      5;  ///< px, odd, 1..63; window_width * window_height - 1 is 1..63 (a code is at most 63 bits); I
  CensusBitOrder bit_order = CensusBitOrder::kMsbFirst;   ///< own choice; without influence on the disparity
  CensusComparison comparison = CensusComparison::kLess;  ///< own choice
  CensusBorder border = CensusBorder::kReplicate;         ///< own choice

  int neighbours() const { return window_width * window_height - 1; }
  int code_bits() const { return enabled ? neighbours() : kGrayBits; }  ///< of what comes out
  void validate() const;
};

/// Census transform of one image (pre-processing stage; one instance per image).
///
/// The neighbours of pixel (x, y) are the pixels of the window centred on it, in raster order, without the
/// centre. Neighbour i (0 = top left) sets bit neighbours()-1-i (kMsbFirst) or bit i (kLsbFirst) when
/// `neighbour <op> centre` holds; higher bits are 0. Border as in CensusBorder.
class Census {
 public:
  Census(const CensusConfig& config, int width, int height);

  /// One row of `width` intensities; emits rows of `width` codes. With CensusBorder::kDelayLine a row is
  /// complete when the pixels behind the row that its window ends in are there: with the next one.
  void push(const Gray* row, const RowSink<CensusCode>& emit);

  int look_ahead_rows() const { return config_.enabled ? config_.window_height / 2 : 0; }
  int look_ahead_pixels() const { return config_.enabled ? config_.window_width / 2 : 0; }

  /// window_height - 1 lines of intensities and the window itself.
  /// `at_once`: pixels of a row that the circuit works on in one firing, in windows side by side.
  std::int64_t storage_bits(int at_once = 1) const;

 private:
  Gray* padded(int y);  ///< first pixel of image row y in the ring of lines
  const Gray* line_for(int y);
  void push_padded(const Gray* row, const RowSink<CensusCode>& emit);
  void push_raster(const Gray* row, const RowSink<CensusCode>& emit);
  void transform(int y, const RowSink<CensusCode>& emit);

  CensusConfig config_;
  int width_;
  int height_;
  int next_row_ = 0;
  RasterDelay<Gray> raster_;        ///< in place of the lines (CensusBorder::kDelayLine)
  int pad_;                         ///< px left and right of each stored line
  std::vector<Gray> lines_;         ///< window_height padded lines, row y in line y mod window_height
  std::vector<Gray> zero_line_;     ///< stands for rows outside the image (CensusBorder::kZero)
  std::vector<std::uint8_t> byte_;  ///< eight bits of the codes of one row
  std::vector<CensusCode> codes_;
};

}  // namespace parallax
