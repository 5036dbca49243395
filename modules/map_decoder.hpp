// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "modules/rectification_map.hpp"

namespace parallax {

/// Layout of a row of the compressed rectification map (MAP_FORMAT.md).
namespace map_code {
inline constexpr int kBlockPixels = 16;
inline constexpr int kWidthFieldBits = 4;
inline constexpr int kComponents = 4;  // left dx, left dy, right dx, right dy
inline constexpr int kHeaderBits = kComponents * kWidthFieldBits;
}  // namespace map_code

/// Smallest and largest number of bytes that a row of `width` pixels can take.
std::size_t least_row_bytes(int width);
std::size_t worst_row_bytes(int width, const OffsetRange& range);

/// Where the codes of a row end: `end_bit` receives for each pixel the position, counted from the start of
/// the row, of the first bit after its code. Throws UserError where the bytes are no row of such a map, as
/// MapDecoder::push() does, but for what it takes the offsets to see. `row` is named in the message.
void map_code_ends(const std::uint8_t* bytes, std::size_t size, const OffsetRange& range, int row,
                   std::vector<std::uint32_t>& end_bit);

/// Map decoder: the compressed bytes of one row -> offset pairs of that row.
///
/// A row starts at a byte. Bits are taken from the least significant end of each byte upward. The row is cut
/// into blocks of 16 pixels (the last one may be shorter). A block is four 4-bit widths w (left dx, left dy,
/// right dx, right dy), then for each of its pixels the residuals left dx, left dy, right dx, right dy, each
/// a two's complement number of w bits (w = 0: residual 0). The row ends with zero bits up to the next byte.
/// A component's value is
///   wrap(prediction + residual), prediction = left + up - upleft,
/// in the first column up, in the first row left, at the origin 0; wrap() keeps the lowest offset_bits() bits
/// as a two's complement number. So one pair per cycle needs no look-ahead, at most 76 bits (the header and
/// four residuals of 15 bits), 64 with the default range, and one row of storage for the prediction.
class MapDecoder {
 public:
  MapDecoder(const OffsetRange& range, int width, int height);

  /// Decodes row 0, 1, ... height-1, then the next frame's row 0. `bytes` starts at the row and may hold more
  /// than the row; the return value is the number of bytes the row took. Throws UserError on bytes that are
  /// no row of a map of this size; the decoder then starts again with row 0.
  std::size_t push(const std::uint8_t* bytes, std::size_t size, OffsetPair* out);

  int look_ahead_rows() const { return 0; }
  int look_ahead_pixels() const { return 0; }
  /// The offset pairs of one row.
  std::int64_t storage_bits() const;

 private:
  std::size_t decode(std::size_t size, OffsetPair* out) const;
  void check_range(const OffsetPair* row) const;

  OffsetRange range_;
  int offset_bits_;
  int width_;
  int height_;
  int y_ = 0;
  std::vector<OffsetPair> previous_;  // the row above; zeros above row 0
  // The row's bytes, padded so that a field can be fetched as one 64-bit word.
  std::vector<std::uint8_t> bytes_;
};

}  // namespace parallax
