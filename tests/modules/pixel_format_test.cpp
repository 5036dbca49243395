// SPDX-License-Identifier: Apache-2.0
#include "modules/pixel_format.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "modules/pixel_unpack_stage.hpp"
#include "tlm/clock_domain.hpp"

namespace parallax::test {
namespace pixel_format_test {

constexpr PixelFormat kAll[] = {PixelFormat::kMono8, PixelFormat::kMono12Packed, PixelFormat::kMono12,
                                PixelFormat::kRgb8, PixelFormat::kBayer8};

/// Value of `width` bits from bit `low` on, bit by bit, low bits of a byte first.
unsigned bits(const std::vector<std::uint8_t>& bytes, std::size_t low, std::size_t width) {
  unsigned value = 0;
  for (std::size_t i = 0; i < width; ++i) value |= (bytes[(low + i) / 8] >> (low + i) % 8 & 1U) << i;
  return value;
}

Gray naive(PixelFormat format, const std::vector<std::uint8_t>& bytes, std::size_t x) {
  switch (format) {
    case PixelFormat::kMono12Packed:
      return static_cast<Gray>(bits(bytes, 12 * x, 12) / 16);
    case PixelFormat::kMono12:
      return static_cast<Gray>(bits(bytes, 16 * x, 12) / 16);
    case PixelFormat::kRgb8: {
      const unsigned sum =
          77 * bits(bytes, 24 * x, 8) + 150 * bits(bytes, 24 * x + 8, 8) + 29 * bits(bytes, 24 * x + 16, 8);
      return static_cast<Gray>((sum + 128) / 256);
    }
    default:
      return static_cast<Gray>(bits(bytes, 8 * x, 8));
  }
}

TEST(PixelFormat, UnpackingIsThatOfTheBits) {
  std::mt19937 random(1);
  for (const PixelFormat format : kAll) {
    for (std::size_t width = 1; width <= 40; ++width) {
      std::vector<std::uint8_t> bytes(bytes_of(format, width));
      for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
      std::vector<Gray> pixels(width);
      unpack_pixels(format, bytes.data(), width, pixels.data());
      for (std::size_t x = 0; x < width; ++x)
        EXPECT_EQ(pixels[x], naive(format, bytes, x)) << width << " " << x;
    }
  }
}

TEST(PixelFormat, GreyComesBackAsItWas) {
  for (const PixelFormat format : kAll) {
    std::vector<Gray> grey(257);
    for (std::size_t i = 0; i < grey.size(); ++i) grey[i] = static_cast<Gray>(i * 37);
    std::vector<std::uint8_t> bytes(bytes_of(format, grey.size()), 0xA5);
    pack_pixels(format, grey.data(), grey.size(), bytes.data());
    std::vector<Gray> back(grey.size());
    unpack_pixels(format, bytes.data(), grey.size(), back.data());
    EXPECT_EQ(back, grey);
  }
}

TEST(PixelFormat, PackedTwelveBitIsThePublishedLayout) {
  const Gray pixels[] = {0xAB, 0xCD};  // 0xAB0, 0xCD0
  std::uint8_t bytes[3];
  pack_pixels(PixelFormat::kMono12Packed, pixels, 2, bytes);
  EXPECT_EQ(bytes[0], 0xB0);
  EXPECT_EQ(bytes[1], 0x0A);
  EXPECT_EQ(bytes[2], 0xCD);
}

// Firing by firing: which bytes a pixel needs, and when the burst with them is read.
TEST(PixelUnpackStage, ReadsABurstWithThePixelThatEndsInIt) {
  const ClockDomain clock("clock", Hertz(100'000'000));
  Dataflow dataflow("dataflow");
  int number = 0;
  for (const PixelFormat format : kAll) {
    for (const int burst : {1, 2, 4, 5, 16, 128}) {
      for (const std::uint64_t width : {2u, 8u, 30u, 130u}) {
        PixelUnpackConfig config;
        config.format = format;
        config.burst = Bytes(burst);
        config.width = width;
        config.pieces = 3;
        config.piece_bytes = bytes_of(format, width);
        const PixelUnpackStage stage(("stage" + std::to_string(number++)).c_str(), config, clock, dataflow);
        std::vector<std::pair<int, int>> have;  // read, written
        const Schedule& schedule = stage.schedule();
        for (const Schedule::Segment& segment : schedule.segments()) {
          for (std::uint64_t i = 0; i < segment.repeat; ++i) {
            for (std::uint32_t p = 0; p < segment.phase_count; ++p) {
              const Phase& phase = schedule.phases()[segment.first_phase + p];
              for (std::uint32_t n = 0; n < phase.count; ++n) have.emplace_back(phase.consume, phase.produce);
            }
          }
        }
        std::vector<std::pair<int, int>> want;
        const auto pixel_bits = static_cast<std::uint64_t>(bits_per_pixel(format));
        for (int piece = 0; piece < 3; ++piece) {
          std::uint64_t bytes_read = 0;
          for (std::uint64_t x = 0; x < width; ++x) {
            bool read = false;
            while (bytes_read * 8 < (x + 1) * pixel_bits) {
              if (read) want.emplace_back(1, 0);
              read = true;
              bytes_read += static_cast<std::uint64_t>(burst);
            }
            want.emplace_back(read ? 1 : 0, 1);
          }
        }
        EXPECT_EQ(have, want) << static_cast<int>(format) << " " << burst << " " << width;
      }
    }
  }
}

}  // namespace pixel_format_test
}  // namespace parallax::test
