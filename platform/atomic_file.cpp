// SPDX-License-Identifier: Apache-2.0
#include "platform/atomic_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "tlm/error.hpp"

namespace parallax {
namespace {

namespace fs = std::filesystem;

/// Returns 0 or the errno of the first fault.
int write_all(const fs::path& path, const std::vector<unsigned char>& bytes) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) {
    return errno;
  }
  const bool given = bytes.empty() || std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  const bool written = given && std::fflush(file) == 0;
  const int write_error = written ? 0 : errno;
  // Network file systems report a full disk as late as here.
  const int close_error = std::fclose(file) == 0 ? 0 : errno;
  return write_error != 0 ? write_error : close_error;
}

void require(int error, const fs::path& target) {
  if (error != 0) {
    throw UserError(fmt::format("cannot write {}: {}", target.string(), std::strerror(error)));
  }
}

}  // namespace

void write_atomically(const fs::path& target, const std::vector<unsigned char>& bytes) {
  std::error_code ignored;
  if (fs::is_directory(target, ignored)) {
    require(EISDIR, target);
  }
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored)) {
    // Renaming would put a file in the place of the device.
    require(write_all(target, bytes), target);
    return;
  }
  // Hidden, and with the process number: two runs into one folder do not meet.
  const fs::path temporary =
      target.parent_path() / fmt::format(".{}.{}.part", target.filename().string(), ::getpid());
  int error = write_all(temporary, bytes);
  if (error == 0 && std::rename(temporary.c_str(), target.c_str()) != 0) {
    error = errno;
  }
  if (error != 0) {
    fs::remove(temporary, ignored);
  }
  require(error, target);
}

}  // namespace parallax
