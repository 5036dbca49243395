// SPDX-License-Identifier: Apache-2.0
#include "platform/results/file_content.hpp"

#include <zlib.h>

#include <algorithm>
#include <limits>

namespace parallax {

void FileContent::add(const void* data, std::size_t count) {
  bytes += count;
  const auto* at = static_cast<const Bytef*>(data);
  while (count > 0) {
    const auto part = static_cast<uInt>(std::min<std::size_t>(count, std::numeric_limits<uInt>::max()));
    crc = static_cast<std::uint32_t>(::crc32(crc, at, part));
    at += part;
    count -= part;
  }
}

}  // namespace parallax
