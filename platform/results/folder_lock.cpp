// SPDX-License-Identifier: Apache-2.0
#include "platform/results/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "tlm/error.hpp"

namespace parallax {

FolderLock::FolderLock(const std::filesystem::path& folder)
    : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0 || ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  ::close(descriptor_);
  throw UserError(fmt::format(
      "another parallax is writing to {}; wait until it ends, or choose another folder", folder.string()));
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool FolderLock::is_at(const std::filesystem::path& folder) const {
  struct stat locked {
  }, found{};
  if (descriptor_ < 0 || ::fstat(descriptor_, &locked) != 0) return true;
  return ::stat(folder.c_str(), &found) == 0 && found.st_dev == locked.st_dev &&
         found.st_ino == locked.st_ino;
}

}  // namespace parallax
