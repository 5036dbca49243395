// SPDX-License-Identifier: Apache-2.0
// The values that travel between stages, one type a token.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tlm/token_bits.hpp"

namespace parallax {

/// Image intensity, 8 bit.
using Gray = std::uint8_t;
inline constexpr int kGrayBits = 8;

/// Census code: one bit per neighbour in the window (at most 63 neighbours). Without a census transform, the
/// intensity.
using CensusCode = std::uint64_t;

/// Sum of the path costs of one pixel at one disparity (semi-global matching).
using Cost = std::uint16_t;

/// Displacement of one pixel in 1/2^fraction_bits px: the source pixel is (x + dx, y + dy).
struct Offset {
  std::int16_t dx = 0;
  std::int16_t dy = 0;
};

/// One entry of the rectification map: both images interleaved (paper, section "Rectification").
struct OffsetPair {
  Offset left;
  Offset right;
};

inline bool operator==(const Offset& a, const Offset& b) { return a.dx == b.dx && a.dy == b.dy; }
inline bool operator==(const OffsetPair& a, const OffsetPair& b) {
  return a.left == b.left && a.right == b.right;
}

/// What made a pixel invalid, or what its value came from. A model-side label: the device sends the value
/// alone. One that is added has its name and colour in platform/results/result_images.cpp.
enum class Cause : std::uint8_t {
  kMatched = 0,       ///< valid, from matching
  kInterpolated = 1,  ///< valid, filled by gap interpolation
  kBorder = 2,        ///< invalid: masked image border
  kUniqueness = 3,    ///< invalid: uniqueness check
  kConsistency = 4,   ///< invalid: consistency check
  kTexture = 5,       ///< invalid: texture filter
  kSpeckle = 6,       ///< invalid: speckle filter
  kNoise = 7,         ///< invalid: noise reduction
  kEnd                ///< no cause: how many there are
};
inline constexpr auto kCauses = static_cast<std::size_t>(Cause::kEnd);

/// 12-bit fixed-point disparity: 8 integer and 4 fraction bits; 0xFFF is invalid.
inline constexpr std::uint16_t kInvalidDisparity = 0xFFF;
inline constexpr int kDisparityFractionBits = 4;
inline constexpr int kDisparityBits = 12;  ///< of its value, which is what the wires have of a disparity

struct Disparity {
  std::uint16_t value = kInvalidDisparity;  ///< 1/16 px, or kInvalidDisparity
  Cause cause = Cause::kMatched;

  bool valid() const { return value != kInvalidDisparity; }
};

template <>
inline constexpr int kLeastBits<Disparity> = kDisparityBits;

inline bool operator==(const Disparity& a, const Disparity& b) {
  return a.value == b.value && a.cause == b.cause;
}

}  // namespace parallax
