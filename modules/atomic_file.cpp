// SPDX-License-Identifier: Apache-2.0
#include "modules/atomic_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "tlm/error.hpp"

namespace parallax {

namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

[[noreturn]] void fail(const std::string& path, const char* what, int error) {
  throw UserError(fmt::format("{}: {}: {}", path, what, std::strerror(error)));
}

// 0, or the error. Closing reports what a full disk or a network file system held back.
int write_all(const std::string& path, const std::uint8_t* bytes, std::size_t size) {
  File file(std::fopen(path.c_str(), "wb"));
  if (!file) {
    return errno;
  }
  if (std::fwrite(bytes, 1, size, file.get()) != size) {
    return errno;
  }
  return std::fclose(file.release()) == 0 ? 0 : errno;
}

}  // namespace

void write_file(const std::string& path, const std::uint8_t* bytes, std::size_t size) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_directory(status)) {
    fail(path, "cannot write", EISDIR);
  }
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    if (const int error = write_all(path, bytes, size); error != 0) {
      fail(path, "cannot write", error);
    }
    return;
  }
  const std::string temporary = fmt::format("{}.{}.tmp", path, ::getpid());
  int error = write_all(temporary, bytes, size);
  if (error == 0 && std::rename(temporary.c_str(), path.c_str()) != 0) {
    error = errno;
  }
  if (error != 0) {
    std::remove(temporary.c_str());
    fail(path, "cannot write", error);
  }
}

std::vector<std::uint8_t> read_file(const std::string& path) {
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file) {
    fail(path, "cannot read", errno);
  }
  std::vector<std::uint8_t> bytes;
  std::vector<std::uint8_t> chunk(std::size_t{1} << 16);
  while (const std::size_t count = std::fread(chunk.data(), 1, chunk.size(), file.get())) {
    bytes.insert(bytes.end(), chunk.begin(), chunk.begin() + static_cast<std::ptrdiff_t>(count));
  }
  if (std::ferror(file.get()) != 0) {
    fail(path, "cannot read", errno);
  }
  return bytes;
}

}  // namespace parallax
