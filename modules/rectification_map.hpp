// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "modules/pixel.hpp"

namespace parallax {

/// What bounds the offsets of a rectification map.
struct OffsetRange {
  /// Rows and columns that the rectification can reach around a pixel; odd, 1..2047. Source: 79 (S, paper).
  int window = 79;
  /// Fraction bits of an offset, 0..8. Source: own choice, 5 as in OpenCV's remap. The paper says "subpixel".
  int fraction_bits = 5;

  static constexpr int kLargestWindow = 2047;
  /// The width field of the compressed map is 4 bits, so an offset has at most 15.
  static constexpr int kLargestLimit = 16383;

  /// Throws UserError unless both are in range and an offset fits into 15 bits.
  void validate() const;

  /// Largest whole displacement in px: (window - 1) / 2.
  int reach() const { return (window - 1) / 2; }
  /// Largest offset in 1/2^fraction_bits px.
  int limit() const { return reach() << fraction_bits; }
  /// Bits of a two's complement number that holds -limit()..limit(): 12 by default.
  int offset_bits() const;
};

inline bool operator==(const OffsetRange& a, const OffsetRange& b) {
  return a.window == b.window && a.fraction_bits == b.fraction_bits;
}

/// Displacements of all pixels of both rectified images, quantised. Rectified pixel (x, y) shows the raw
/// image at (x + dx / 2^fraction_bits, y + dy / 2^fraction_bits).
struct RectificationMap {
  int width = 0;   ///< px
  int height = 0;  ///< px
  OffsetRange range;
  std::vector<OffsetPair> offsets;  ///< row-major, width * height

  const OffsetPair* row(int y) const { return offsets.data() + static_cast<std::size_t>(y) * width; }

  /// The map of the columns first..first+count-1, for a vertical tile. Offsets stay as they are: they are
  /// relative.
  RectificationMap columns(int first, int count) const;
};

/// Pixels that a map may have: what is made of one stays in memory. The hardware's largest image has a
/// twentieth of it.
constexpr std::int64_t kMostMapPixels = std::int64_t{1} << 26;
/// Throws UserError for more.
void check_map_size(std::int64_t width, std::int64_t height);

/// The map of a pair that is rectified already: all offsets zero.
RectificationMap identity_map(int width, int height, const OffsetRange& range = {});

}  // namespace parallax
