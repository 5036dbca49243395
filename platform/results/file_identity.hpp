// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace parallax {

/// A file that a command reads, and how its user named it: "--left left.png", "list.txt: left.png".
struct NamedInput {
  std::string name;
  std::filesystem::path path;
};

/// Files by device and inode, so that a link or another spelling of a path is the same file. What does not
/// exist is not kept.
class InputFiles {
 public:
  explicit InputFiles(const std::vector<NamedInput>& inputs = {});

  /// How the user named the file that `path` leads to, if it is one of these.
  std::optional<std::string> name_of(const std::filesystem::path& path) const;

 private:
  struct Entry {
    dev_t device;
    ino_t inode;
    std::string name;
  };
  std::vector<Entry> entries_;  ///< by device and inode
};

/// Throws UserError when `target`, which is to be written, is one of `inputs`. `option`: where it was named.
void refuse_to_replace(const std::vector<NamedInput>& inputs, const std::string& option,
                       const std::filesystem::path& target);

}  // namespace parallax
