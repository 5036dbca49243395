// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "modules/rectification_map.hpp"
#include "modules/row_sink.hpp"

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

/// Compresses a map row by row, without loss. Holds the compressed rows and two more.
class MapEncoder {
 public:
  MapEncoder(int width, int height, const OffsetRange& range);

  /// The next of `height` rows. Throws std::invalid_argument for an offset beyond the range.
  void push(const OffsetPair* row);
  /// The rows of another encoder of this width and range, which has some, as the next rows.
  void append(const MapEncoder& below);
  /// The map, after its last row.
  EncodedMap take();

 private:
  EncodedMap map_;
  std::vector<OffsetPair> first_;     // row 0
  std::vector<OffsetPair> previous_;  // the row above; zeros above row 0
};

/// Compresses without loss. Throws std::invalid_argument for a map whose offsets are beyond its own range.
EncodedMap encode(const RectificationMap& map);

/// Hands out the rows from the top. Throws UserError if the bytes are not rows of the stated lengths.
void decode_rows(const EncodedMap& encoded, const RowSink<OffsetPair>& emit);
RectificationMap decode(const EncodedMap& encoded);

}  // namespace parallax
