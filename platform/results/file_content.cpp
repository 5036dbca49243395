// SPDX-License-Identifier: Apache-2.0
#include "platform/results/file_content.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>
#include <vector>

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

FileContent content_of(const std::filesystem::path& path, std::uint64_t longest) {
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  FileContent content;
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
  std::vector<char> chunk(std::size_t{1} << 16);
  while (file && content.bytes <= longest) {
    const std::size_t count = std::fread(chunk.data(), 1, chunk.size(), file.get());
    if (count == 0) break;
    content.add(chunk.data(), count);
  }
  return content;
}

}  // namespace parallax
