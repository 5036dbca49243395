// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "modules/rectification_map.hpp"

namespace parallax {

/// A rectification map as the hardware reads it: one byte stream with both images interleaved. MAP_FORMAT.md
/// describes it byte for byte, map_decoder.hpp the code of a row.
struct EncodedMap {
  int width = 0;   ///< px
  int height = 0;  ///< px
  OffsetRange range;
  std::vector<std::uint8_t> bytes;       ///< the rows, one after the other
  std::vector<std::uint32_t> row_bytes;  ///< length of each row in bytes

  /// Bytes per pixel and image; the aim is at most 1.
  double bytes_per_pixel() const;
};

/// Compresses without loss. Throws std::invalid_argument for a map whose offsets are beyond its own range.
EncodedMap encode(const RectificationMap& map);

/// Throws UserError if the bytes are not rows of the stated lengths.
RectificationMap decode(const EncodedMap& encoded);

}  // namespace parallax
