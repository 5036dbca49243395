// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "modules/pixel.hpp"
#include "modules/row_sink.hpp"

namespace parallax {

/// The left image in the results.
enum class OutputLeft {
  kGrey,    ///< 1 byte a pixel
  kColour,  ///< 3 bytes a pixel; the model's images are grey, so all three are the same
};

/// Output packing: what the output DMA writes and the link sends, 2.5 bytes a pixel (8-bit left image and
/// 12-bit disparity, hardware S; their order in memory is not published, own choice), or 4.5 with the left
/// image in colour.
///
/// Pixels go in pairs of 5 (9) bytes: the left pixels 2i and 2i+1, then their disparities p0, p1 packed as
/// the device packs 12 bit: p0[7:0], p0[11:8] | p1[3:0] << 4, p1[11:4]. An odd last pixel is followed by a
/// zero pixel.
class OutputPacking {
 public:
  OutputPacking(int width, OutputLeft format);

  /// One row of each; emits row_bytes() bytes.
  void push(const Gray* left, const Disparity* disparities, const RowSink<std::uint8_t>& emit);

  static std::size_t pair_bytes(OutputLeft format) { return 2 * left_bytes(format) + 3; }
  static std::size_t row_bytes(int width, OutputLeft format) {
    return ((width + 1) / 2) * pair_bytes(format);
  }
  /// The first pixel of a pair, 20 or 36 bit.
  std::int64_t storage_bits() const { return 8 * left_bytes(format_) + 12; }

 private:
  static std::size_t left_bytes(OutputLeft format) { return format == OutputLeft::kGrey ? 1 : 3; }

  int width_;
  OutputLeft format_;
  std::vector<std::uint8_t> row_;
};

/// Reads back what OutputPacking wrote: one row of `width` pixels; of a colour the first byte.
void unpack_output(const std::uint8_t* bytes, int width, OutputLeft format, Gray* left,
                   std::uint16_t* disparities);

}  // namespace parallax
