// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "modules/pixel.hpp"

namespace parallax {

/// How a camera sends its pixels and they lie in memory. The core works on 8-bit grey.
enum class PixelFormat {
  kMono8,         ///< 1 byte
  kMono12Packed,  ///< 12 bit, two pixels in three bytes, low bits first: b0 = p0[7:0], b1 = p0[11:8] |
                  ///< p1[3:0] << 4, b2 = p1[11:4]
  kMono12,        ///< 12 bit in the low bits of two bytes, low byte first
  kRgb8,          ///< 3 bytes: red, green, blue
  kBayer8,        ///< 1 byte of one colour
};

/// Bits that a pixel takes: 8, 12, 16, 24.
int bits_per_pixel(PixelFormat format);

/// Bytes of `pixels` in a row; a started byte is a whole one.
inline std::uint64_t bytes_of(PixelFormat format, std::uint64_t pixels) {
  return (pixels * bits_per_pixel(format) + 7) / 8;
}

/// Grey as a camera of this format sends it: 12 bit with four zeros below, three equal colours, or as it is.
/// Writes bytes_of(format, width) bytes.
void pack_pixels(PixelFormat format, const Gray* pixels, std::size_t width, std::uint8_t* bytes);

/// The grey that the core makes of it: the upper 8 of 12 bits; (77 R + 150 G + 29 B + 128) / 256 (ITU-R
/// BT.601 in 8 bit); a Bayer pattern's values as they are, since both images carry the same one and
/// demosaicing is no part of the published pipeline.
void unpack_pixels(PixelFormat format, const std::uint8_t* bytes, std::size_t width, Gray* pixels);

}  // namespace parallax
