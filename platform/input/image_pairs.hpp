// SPDX-License-Identifier: Apache-2.0
// Which files are a stereo pair.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace parallax {

struct ImagePair {
  std::filesystem::path left;
  std::filesystem::path right;
};

/// The pairs of a folder (folder_pairs.hpp), or of a list file, in order. Throws UserError when there are
/// none, or when a file of a pair is missing.
///
/// A list file: two paths a line, relative to the list's folder; a path with spaces in double quotes; #
/// starts a comment.
std::vector<ImagePair> find_image_pairs(const std::filesystem::path& folder_or_list);

}  // namespace parallax
