// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace parallax {

/// Keeps others out of a folder while it lives: who locks it too is refused. The system's lock of the folder
/// itself, so that it leaves no file and ends with the process, however that ends. Where a file system knows
/// no locks, nobody is kept out.
class FolderLock {
 public:
  /// Throws UserError when another process writes there.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Whether the folder that was locked is still the one at this path: who made it may have removed it
  /// before.
  bool is_at(const std::filesystem::path& folder) const;

 private:
  int descriptor_ = -1;
};

}  // namespace parallax
