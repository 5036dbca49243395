// SPDX-License-Identifier: Apache-2.0
#include "platform/input/input_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "platform/files/plain_file.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

[[noreturn]] void fail(const std::string& path, int error) {
  throw UserError(fmt::format("{}: cannot read: {}", path, std::strerror(error)));
}

}  // namespace

std::vector<std::uint8_t> read_file(const std::string& path, std::size_t most) {
  require_plain_file(path);
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (!file) fail(path, errno);
  std::vector<std::uint8_t> bytes;
  std::vector<std::uint8_t> chunk(std::size_t{1} << 16);
  while (const std::size_t count = std::fread(chunk.data(), 1, chunk.size(), file.get())) {
    bytes.insert(bytes.end(), chunk.begin(), chunk.begin() + count);
    if (bytes.size() > most)
      throw UserError(fmt::format("{}: has more than {} MiB, the most that is read", path, most >> 20));
  }
  if (std::ferror(file.get()) != 0) fail(path, errno);
  return bytes;
}

}  // namespace parallax
