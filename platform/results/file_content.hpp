// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
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

/// Of a file, as far as it can be read; of one that may have grown, so many bytes and a little more.
FileContent content_of(const std::filesystem::path& path,
                       std::uint64_t longest = std::numeric_limits<std::uint64_t>::max());

}  // namespace parallax
