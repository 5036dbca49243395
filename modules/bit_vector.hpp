// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace parallax {

/// The wires of a bus: `width` bits, bit 0 the lowest, all 0 at first. Fields are at most 64 bits wide.
class BitVector {
 public:
  explicit BitVector(std::size_t width = 0) : width_(width), words_((width + kWord - 1) / kWord) {}

  std::size_t width() const { return width_; }
  /// The `width` bits (1 to 64) from bit `low` on. std::out_of_range beyond the bus.
  std::uint64_t get(std::size_t low, std::size_t width) const;
  /// Puts the lowest `width` bits of `value` there.
  void set(std::size_t low, std::size_t width, std::uint64_t value);

  /// As bytes lie in memory, bits 0 to 7 first; the last byte is filled up with zeros.
  std::vector<std::uint8_t> bytes() const;
  static BitVector from_bytes(const std::uint8_t* bytes, std::size_t width);

  bool operator==(const BitVector& other) const { return width_ == other.width_ && words_ == other.words_; }

 private:
  static constexpr std::size_t kWord = 64;
  void check(std::size_t low, std::size_t width) const;

  std::size_t width_;
  std::vector<std::uint64_t> words_;
};

}  // namespace parallax
