// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "modules/pixel.hpp"
#include "modules/row_sink.hpp"

namespace parallax {

/// Output packing: what the output DMA writes and the link sends, 2.5 bytes a pixel (8-bit left image and
/// 12-bit disparity, hardware S; their order in memory is not published, own choice).
///
/// Pixels go in pairs of 5 bytes: the left pixels 2i and 2i+1, then their disparities p0, p1 packed as the
/// device packs 12 bit: p0[7:0], p0[11:8] | p1[3:0] << 4, p1[11:4]. An odd last pixel is followed by a zero
/// pixel.
class OutputPacking {
 public:
  explicit OutputPacking(int width);

  /// One row of each; emits row_bytes() bytes.
  void push(const Gray* left, const Disparity* disparities, const RowSink<std::uint8_t>& emit);

  static std::size_t row_bytes(int width) { return static_cast<std::size_t>((width + 1) / 2) * 5; }
  /// The first pixel of a pair, 20 bit.
  std::int64_t storage_bits() const { return 20; }

 private:
  int width_;
  std::vector<std::uint8_t> row_;
};

/// Reads back what OutputPacking wrote: one row of `width` pixels.
void unpack_output(const std::uint8_t* bytes, int width, Gray* left, std::uint16_t* disparities);

}  // namespace parallax
