// SPDX-License-Identifier: Apache-2.0
#include "platform/files/plain_file.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include "tlm/error.hpp"

namespace parallax {

void require_plain_file(const std::string& path, const std::string& expected) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode)) return;
  const char* const kind = S_ISDIR(status.st_mode)    ? "a folder"
                           : S_ISFIFO(status.st_mode) ? "a pipe"
                           : S_ISSOCK(status.st_mode) ? "a socket"
                                                      : "a device";
  throw UserError(fmt::format("{} is {}, expected {}", path, kind, expected));
}

}  // namespace parallax
