// SPDX-License-Identifier: Apache-2.0
#include "platform/results/file_identity.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <tuple>

#include "tlm/error.hpp"

namespace parallax {

InputFiles::InputFiles(const std::vector<NamedInput>& inputs) {
  for (const NamedInput& input : inputs) {
    struct stat found {};
    if (::stat(input.path.c_str(), &found) == 0) entries_.push_back({found.st_dev, found.st_ino, input.name});
  }
  std::stable_sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.device, a.inode) < std::tie(b.device, b.inode);
  });
}

std::optional<std::string> InputFiles::name_of(const std::filesystem::path& path) const {
  struct stat found {};
  if (entries_.empty() || ::stat(path.c_str(), &found) != 0) return std::nullopt;
  const auto entry = std::lower_bound(
      entries_.begin(), entries_.end(), found, [](const Entry& e, const struct stat& wanted) {
        return std::tie(e.device, e.inode) < std::tie(wanted.st_dev, wanted.st_ino);
      });
  if (entry == entries_.end() || entry->device != found.st_dev || entry->inode != found.st_ino)
    return std::nullopt;
  return entry->name;
}

void refuse_to_replace(const std::vector<NamedInput>& inputs, const std::string& option,
                       const std::filesystem::path& target) {
  if (const auto name = InputFiles(inputs).name_of(target)) {
    throw UserError(
        fmt::format("{} would replace {}, which is read: {} is the same file; choose another name", option,
                    *name, target.string()));
  }
}

}  // namespace parallax
