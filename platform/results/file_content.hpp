// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <tuple>

namespace parallax {

/// What a file holds: how many bytes, and their CRC-32.
struct FileContent {
  std::uint64_t bytes = 0;
  std::uint32_t crc = 0;

  void add(const void* data, std::size_t count);
  bool operator<(const FileContent& other) const {
    return std::tie(bytes, crc) < std::tie(other.bytes, other.crc);
  }
};

}  // namespace parallax
