// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace parallax {

/// Fields one after the other into bytes, from bit 0 of the first byte on, as a TokenFormat lays them out:
/// for tokens by the million, of which a BitVector each would take too long.
class BitPacker {
 public:
  /// Appends the `width` bits (1 to 32) of `value`, which has no others.
  void field(std::uint64_t value, int width) {
    pending_ |= value << bits_;
    bits_ += width;
    while (bits_ >= kByte) {
      bytes_.push_back(static_cast<std::uint8_t>(pending_));
      pending_ >>= kByte;
      bits_ -= kByte;
    }
  }
  /// The token ends: the next one begins with a byte.
  void end_token() {
    if (bits_ > 0) field(0, kByte - bits_);
  }
  /// What has been packed; begins anew.
  std::vector<std::uint8_t> take() {
    std::vector<std::uint8_t> all;
    all.reserve(bytes_.size());
    all.swap(bytes_);
    return all;
  }

 private:
  static constexpr int kByte = 8;

  std::vector<std::uint8_t> bytes_;
  std::uint64_t pending_ = 0;
  int bits_ = 0;  // of it, less than a byte
};

}  // namespace parallax
