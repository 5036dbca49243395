// SPDX-License-Identifier: Apache-2.0
#include "platform/files/open_stream.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>

#include "tlm/error.hpp"

namespace parallax {
namespace {

// Of a pipe without data, whether somebody has it open for writing: it tells by what is copied from it, and
// takes nothing from it.
bool has_writer(int pipe) {
  constexpr int kMilliseconds = 1000;
  pollfd readable{pipe, POLLIN, 0};
  if (::poll(&readable, 1, kMilliseconds) != 0) return true;
  std::array<int, 2> copy{};
  if (::pipe2(copy.data(), O_CLOEXEC) != 0) return true;
  const bool none = ::tee(pipe, copy[1], 1, SPLICE_F_NONBLOCK) == 0;
  for (const int end : copy) ::close(end);
  return !none;
}

}  // namespace

int open_stream(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  struct stat status {};
  if (descriptor < 0 || ::fstat(descriptor, &status) != 0) return descriptor;
  if (S_ISFIFO(status.st_mode) && !has_writer(descriptor)) {
    ::close(descriptor);
    throw UserError(fmt::format("{} is a pipe into which nobody writes", path));
  }
  ::fcntl(descriptor, F_SETFL, ::fcntl(descriptor, F_GETFL) & ~O_NONBLOCK);
  return descriptor;
}

}  // namespace parallax
