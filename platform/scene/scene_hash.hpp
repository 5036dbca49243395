// SPDX-License-Identifier: Apache-2.0
// Counter-based random numbers: the same integers on every machine, in any order of evaluation.
#pragma once

#include <cstdint>

namespace parallax {

/// Finaliser of splitmix64 (Steele, Lea, Flood, OOPSLA 2014): a bijection of 64-bit words that mixes all
/// bits.
inline std::uint64_t scene_hash(std::uint64_t word) {
  word += 0x9E3779B97F4A7C15u;
  word = (word ^ (word >> 30)) * 0xBF58476D1CE4E5B9u;
  word = (word ^ (word >> 27)) * 0x94D049BB133111EBu;
  return word ^ (word >> 31);
}

inline std::uint64_t scene_hash(std::uint64_t seed, std::uint64_t counter) {
  return scene_hash(scene_hash(seed) ^ counter);
}

/// Uniform in [-1, 1), exact in a double.
inline double scene_uniform(std::uint64_t seed, std::uint64_t counter) {
  return static_cast<double>(scene_hash(seed, counter) >> 11) / 4503599627370496.0 - 1.0;
}

/// Variance of scene_normal(): the sum of eight uniform bytes.
inline constexpr double kSceneNormalVariance = 8.0 * (256.0 * 256.0 - 1.0) / 12.0;

/// Integer with mean 0 and the variance above, close to normal (it reaches 4.9 standard deviations).
inline int scene_normal(std::uint64_t word) {
  constexpr std::uint64_t kEvenBytes = 0x00FF00FF00FF00FFu;
  const std::uint64_t pairs = (word & kEvenBytes) + ((word >> 8) & kEvenBytes);
  return static_cast<int>((pairs * 0x0001000100010001u) >> 48) - 8 * 255 / 2;
}

}  // namespace parallax
