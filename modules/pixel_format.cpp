// SPDX-License-Identifier: Apache-2.0
#include "modules/pixel_format.hpp"

#include <algorithm>

namespace parallax {

int bits_per_pixel(PixelFormat format) {
  switch (format) {
    case PixelFormat::kMono8:
    case PixelFormat::kBayer8:
      return 8;
    case PixelFormat::kMono12Packed:
      return 12;
    case PixelFormat::kMono12:
      return 16;
    case PixelFormat::kRgb8:
      return 24;
  }
  return 8;
}

void pack_pixels(PixelFormat format, const Gray* pixels, std::size_t width, std::uint8_t* bytes) {
  switch (format) {
    case PixelFormat::kMono8:
    case PixelFormat::kBayer8:
      std::copy_n(pixels, width, bytes);
      break;
    case PixelFormat::kMono12Packed:
      std::fill_n(bytes, bytes_of(format, width), std::uint8_t{0});
      for (std::size_t x = 0; x < width; ++x) {
        const unsigned value = unsigned{pixels[x]} << 4;
        std::uint8_t* at = bytes + x / 2 * 3;
        if (x % 2 == 0) {
          at[0] = static_cast<std::uint8_t>(value);
          at[1] = static_cast<std::uint8_t>(value >> 8);
        } else {
          at[1] = static_cast<std::uint8_t>(at[1] | value << 4);
          at[2] = static_cast<std::uint8_t>(value >> 4);
        }
      }
      break;
    case PixelFormat::kMono12:
      for (std::size_t x = 0; x < width; ++x) {
        bytes[2 * x] = static_cast<std::uint8_t>(pixels[x] << 4);
        bytes[2 * x + 1] = static_cast<std::uint8_t>(pixels[x] >> 4);
      }
      break;
    case PixelFormat::kRgb8:
      for (std::size_t x = 0; x < width; ++x) std::fill_n(bytes + 3 * x, 3, pixels[x]);
      break;
  }
}

void unpack_pixels(PixelFormat format, const std::uint8_t* bytes, std::size_t width, Gray* pixels) {
  switch (format) {
    case PixelFormat::kMono8:
    case PixelFormat::kBayer8:
      std::copy_n(bytes, width, pixels);
      break;
    case PixelFormat::kMono12Packed:
      for (std::size_t x = 0; x < width; ++x) {
        const std::uint8_t* at = bytes + x / 2 * 3;
        pixels[x] = x % 2 == 0 ? static_cast<Gray>(at[0] >> 4 | (at[1] & 0xF) << 4) : at[2];
      }
      break;
    case PixelFormat::kMono12:
      for (std::size_t x = 0; x < width; ++x) {
        pixels[x] = static_cast<Gray>(bytes[2 * x] >> 4 | (bytes[2 * x + 1] & 0xF) << 4);
      }
      break;
    case PixelFormat::kRgb8:
      for (std::size_t x = 0; x < width; ++x) {
        const std::uint8_t* rgb = bytes + 3 * x;
        pixels[x] = static_cast<Gray>((77 * rgb[0] + 150 * rgb[1] + 29 * rgb[2] + 128) / 256);
      }
      break;
  }
}

}  // namespace parallax
